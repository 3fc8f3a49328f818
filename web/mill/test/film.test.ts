// SPDX-License-Identifier: MIT
// The film: its shots in order, without a browser, and what a first visitor sees of it.
import { Vector3 } from "three";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { Row, StateFrame } from "@tribo/protocol/frames";
import type { Command } from "@tribo/protocol/messages";
import { violations } from "../../testing/axe.js";
import { PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, MillPage } from "../../testing/mill_page.js";
import { between, Director, FILM, PRELUDE, type Phase, type Stage } from "../src/film/director.js";

const POSE = { target: new Vector3(), towards: new Vector3(0, -1, 0), distance: 100 };

/** A page whose clock obeys at once, at most so fast, program seconds per second. */
class FakePage {
  time = 0;
  speed = 1;
  playing = false;
  curtain = 1;
  fill = 0;
  bare = false;
  colours = "plain";
  glows = false;
  revealed = false;
  readonly phases: Phase[] = [];
  readonly shown: string[] = [];
  rows: Row[] = [];
  readonly director: Director;

  constructor(
    readonly duration: number,
    readonly cutFrom: number,
    private readonly fastest = Infinity,
    still = false,
  ) {
    this.director = new Director(this.stage(), still, (phase) => this.phases.push(phase));
  }

  private stage(): Stage {
    const state = () =>
      ({ time: this.time, tip: [1, 2, 3], cutting: this.time >= this.cutFrom }) as unknown as StateFrame;
    const rows = () => this.rows;
    const { duration } = this;
    const scene = {
      pose: POSE,
      wholePose: () => ({ ...POSE, distance: 300 }),
      partPose: () => ({ ...POSE, distance: 250 }),
      setCurtain: (share: number) => (this.curtain = share),
      setFill: (share: number) => (this.fill = share),
      setBare: (on: boolean) => (this.bare = on),
    };
    this.eye = scene;
    return {
      scene,
      duration,
      get state() {
        return state();
      },
      get rows() {
        return rows();
      },
      send: (command: Command) => this.obey(command),
      colour: (by) => (this.colours = by),
      reveal: () => (this.revealed = true),
      glow: (on) => (this.glows = on),
    };
  }
  eye!: { pose: { distance: number; towards: Vector3 } };

  private obey(command: Command): void {
    if (command.op === "seek") this.time = command.t_s;
    else if (command.op === "speed") this.speed = command.value;
    else if (command.op === "play" || command.op === "pause") this.playing = command.op === "play";
  }

  /** Runs for so long, s; returns when the film ended. */
  run(seconds: number, from = 0): number {
    const step = 1 / 30;
    for (let now = from; now < from + seconds; now += step) {
      if (this.playing) this.time = Math.min(this.time + step * Math.min(this.speed, this.fastest), this.duration);
      this.director.each(now);
      const shows = this.director.shows;
      if (shows && shows !== this.shown.at(-1)) this.shown.push(shows);
      if (!shows) return now;
    }
    return Infinity;
  }
}
const ORDER = ["block", "approach", "first pass", "the rest", "verdict"];

describe("the film", () => {
  it("is half a minute: the block, the first pass at true speed, the rest, the verdict", () => {
    const page = new FakePage(176, 1);
    page.rows = [{ time: 1 } as Row];
    page.director.play(FILM, 0);
    expect(page.bare).toBe(true);
    const took = page.run(60);
    expect(page.shown).toEqual(ORDER);
    expect(took).toBeGreaterThan(24);
    expect(took).toBeLessThan(30);
    expect(page).toMatchObject({ time: 176, colours: "force", glows: true, fill: 0, bare: false, curtain: 1 });
    expect(page.phases).toEqual(["plays", "ended"]);
  });

  it("shows the first pass at its true speed from just before the cut, and lets the curtain sink after it", () => {
    const page = new FakePage(500, 42);
    page.rows = [{ time: 42 } as Row];
    page.director.play(FILM, 0);
    page.run(6);
    expect(page.director.shows).toBe("first pass");
    expect(page.speed).toBe(1);
    expect(page.time).toBeGreaterThan(44);
    expect(page.time).toBeLessThan(46);
    expect([page.curtain, page.fill, page.colours]).toEqual([1, 0, "plain"]);
    page.run(10, 6);
    expect(page.director.shows).toBe("the rest");
    expect(page.colours).toBe("force");
    expect(page.curtain).toBeGreaterThan(0.2);
    expect(page.curtain).toBeLessThan(0.8);
  });

  it("runs through the air before a cut that was never milled", () => {
    const page = new FakePage(300, 120);
    page.director.play(FILM, 0);
    const speeds = new Set<number>();
    for (let n = 0; n < 8 && page.shown.at(-1) !== "first pass"; ++n) {
      page.run(0.5, 0.5 * n);
      speeds.add(page.speed);
    }
    expect(page.shown).toEqual(ORDER.slice(0, 3));
    expect([...speeds]).toContain(60);
    expect(page.time).toBeGreaterThanOrEqual(120);
  });

  it("waits for a part that is milled slowly, and not for ever for one that stands still", () => {
    const slow = new FakePage(176, 1, 5);
    slow.rows = [{ time: 1 } as Row];
    slow.director.play(FILM, 0);
    expect(slow.run(120)).toBeGreaterThan(9 + 165 / 5);
    expect(slow.time).toBe(176);
    const stuck = new FakePage(1e6, 1, 1e-9);
    stuck.director.play(FILM, 0);
    expect(stuck.run(200)).toBeLessThan(90);
  });

  it("gives the page back in any shot, as it was", () => {
    for (const at of [0.1, 1, 2.1, 4, 12, 20]) {
      const page = new FakePage(176, 1);
      page.rows = [{ time: 1 } as Row];
      page.director.play(FILM, 0);
      page.run(at);
      page.director.skip();
      expect(page).toMatchObject({ colours: "plain", fill: 0, bare: false, curtain: 1, playing: false, glows: false });
      expect(page.phases).toEqual(["plays", "skipped"]);
      page.director.skip();
      expect(page.phases.length).toBe(2);
    }
  });

  it("waits with the finished part until somebody acts", () => {
    const page = new FakePage(176, 1);
    page.director.play(PRELUDE, 0);
    expect(page.run(1000)).toBe(Infinity);
    expect([page.time, page.bare, page.phases]).toEqual([176, true, ["prelude"]]);
  });

  it("flies to each place without a jump, unless motion is not wanted", () => {
    const page = new FakePage(176, 1);
    page.director.play(FILM, 0);
    let [before, most] = [page.eye.pose.distance, 0];
    for (let n = 0; n < 2000; ++n) {
      page.run(1 / 31, n / 30);
      most = Math.max(most, Math.abs(page.eye.pose.distance - before));
      before = page.eye.pose.distance;
    }
    // The longest way is that from 300 mm to the cutter and back, in 1.6 s and at most 1.5 times as fast as on average.
    expect(most).toBeLessThan((1.5 * 300) / 1.6 / 30);
    const still = new FakePage(176, 1, Infinity, true);
    still.director.play(FILM, 0);
    still.run(0.02);
    expect(still.eye.pose.distance).toBe(300);
  });

  it("keeps the direction of its flight a direction", () => {
    for (let n = 0; n <= 10; ++n) {
      const to = { ...POSE, towards: new Vector3(0.6, 0, 0.8), distance: 10 };
      expect(between(POSE, to, n / 10).towards.length()).toBeCloseTo(1, 12);
    }
  });
});

describe.runIf(hasMillPage)("a first visit", () => {
  let mill: MillPage;
  beforeAll(async () => {
    mill = await MillPage.open();
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  const visit = async (more: { reducedMotion?: "reduce" } = {}, late = "") => {
    const context = await mill.browser.newContext({ viewport: { width: 920, height: 520 }, ...more });
    const page = await context.newPage();
    // The plain light, as the graphics are software.
    await page.addInitScript(() => localStorage.setItem("tribo.look", "plain"));
    mill.watch(page);
    if (late)
      await page.route(late, async (route) => {
        await new Promise((passed) => setTimeout(passed, 3000));
        await route.continue();
      });
    await page.goto(`${mill.server.root}/mill/`);
    return { context, page };
  };
  const phase = "document.body.dataset.film";

  it(
    "begins with the finished part, plays the film with sound, and ends with the verdict",
    async () => {
      const { context, page } = await visit();
      // A picture stands for the part until that is milled, and there is no panel beside it.
      await page.waitForSelector("#poster img", { timeout: PATIENCE_MS });
      expect(await page.evaluate(phase)).toBe("prelude");
      await page.waitForFunction(
        () => (document.querySelector<HTMLImageElement>("#poster img")?.naturalWidth ?? 0) > 300,
      );
      expect(await page.$eval("#scene", (scene) => getComputedStyle(scene).opacity)).not.toBe("1");
      await page.waitForSelector("#hear-it", { timeout: PATIENCE_MS });
      // Milled to its end, without a panel and with nothing else to press.
      await page.waitForFunction(() => document.getElementById("removed")!.textContent === "54.2 cm³", null, {
        timeout: PATIENCE_MS,
      });
      await page.waitForFunction(() => document.querySelector("#poster, .poster-fades") === null);
      await page.waitForFunction(() => getComputedStyle(document.getElementById("scene")!).opacity === "1");
      for (const id of ["begin", "cards", "play", "examples"]) expect(await page.isVisible(`#${id}`)).toBe(false);
      expect(await violations(page)).toEqual([]);
      await page.click("#hear-it");
      await page.waitForSelector("body[data-film=plays]");
      await page.waitForFunction(() => /^0:0[1-9]/.test(document.getElementById("clock")!.textContent), null, {
        timeout: PATIENCE_MS,
      });
      expect(await page.getAttribute("#sound", "aria-pressed")).toBe("true");
      await page.waitForSelector("body:not([data-film])", { timeout: 2 * PATIENCE_MS });
      expect(await page.inputValue("#colouring")).toBe("force");
      expect(await page.textContent("#hint")).toBe(
        "Hold a press on the part to feel it, or drop a job of your own here",
      );
      const glows = page.locator("#program-drawn .glows");
      expect(await page.textContent("#verdict-places li:first-child")).toContain(
        `line ${await glows.getAttribute("data-line")}:`,
      );
      // A click ends the glow; the next visit begins as it always did.
      await page.click("#job");
      await expect.poll(() => glows.count(), { timeout: PATIENCE_MS }).toBe(0);
      await page.reload();
      await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
      await page.waitForTimeout(500);
      expect(await page.evaluate(phase)).toBeUndefined();
      await context.close();
    },
    4 * PATIENCE_MS,
  );

  it(
    "is skipped by a key, a click or the button, and then the block waits to be milled",
    async () => {
      for (const act of ["key", "click", "button"] as const) {
        const { context, page } = await visit();
        await page.waitForSelector("#hear-it", { timeout: PATIENCE_MS });
        // The ways to the buttons stay.
        await page.keyboard.press("Tab");
        expect(await page.evaluate(phase)).toBe("prelude");
        if (act === "key") await page.keyboard.press("x");
        else if (act === "click") await page.mouse.click(40, 200);
        else await page.click("#skip-film");
        await page.waitForSelector("body:not([data-film])");
        expect(await page.$("#poster")).toBeNull();
        await page.waitForSelector("#begin", { timeout: PATIENCE_MS });
        await page.waitForFunction(() => document.getElementById("removed")!.textContent === "0.00 cm³", null, {
          timeout: PATIENCE_MS,
        });
        await context.close();
      }
    },
    3 * PATIENCE_MS,
  );

  it(
    "goes on without the film where a button is pressed before it, early or late, and does what the button is for",
    async () => {
      // What comes late: the script that gives the buttons their meaning, or the first part.
      for (const late of ["**/mill/main-*.js", "**/*.wasm"]) {
        const { context, page } = await visit({}, late);
        if (late.endsWith("wasm"))
          await page.waitForFunction(() => document.querySelector("#learn-begin:not([hidden])"));
        await page.click("#show-panel");
        await page.waitForSelector("#panel", { timeout: PATIENCE_MS });
        await page.waitForSelector("#begin", { timeout: PATIENCE_MS });
        await page.waitForTimeout(1000);
        expect(await page.evaluate(phase)).toBeUndefined();
        expect(await page.$("#poster")).toBeNull();
        expect(await page.isVisible("#panel")).toBe(true);
        await context.close();
      }
    },
    2 * PATIENCE_MS,
  );

  it(
    "has its buttons in reach in the lowest window",
    async () => {
      const { context, page } = await visit();
      await page.setViewportSize({ width: 480, height: 300 });
      await page.click("#hear-it", { timeout: PATIENCE_MS });
      await page.waitForSelector("body[data-film=plays]");
      await page.click("#skip-film", { timeout: PATIENCE_MS });
      await page.waitForSelector("body:not([data-film])");
      await context.close();
    },
    2 * PATIENCE_MS,
  );

  it(
    "has no film where motion is not wanted, but for its button",
    async () => {
      const { context, page } = await visit({ reducedMotion: "reduce" });
      await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
      await page.waitForTimeout(500);
      expect(await page.evaluate(phase)).toBeUndefined();
      expect(await page.$("#poster")).toBeNull();
      await page.click("#film");
      await page.waitForSelector("body[data-film=plays]");
      await page.keyboard.press("Escape");
      await page.waitForSelector("body:not([data-film])");
      await context.close();
    },
    PATIENCE_MS,
  );

  it("makes no error", () => expect(mill.problems).toEqual([]));
});

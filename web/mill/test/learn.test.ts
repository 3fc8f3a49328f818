// SPDX-License-Identifier: MIT
// "Learn by ear": the cuts of the quiz differ as docs/mill-page.md says, and the page keeps the answer to itself.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { MillExports, MillSoundExports } from "@tribo/wasm/exports";
import { violations } from "../../testing/axe.js";
import { PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, MillPage } from "../../testing/mill_page.js";
import { ROOT } from "../../tools/places.js";
import { load } from "../../wasm/test/load.js";
import { clipOf, openFiles, RATE } from "../src/learn/clip.js";
import { filesOf, FLUTES, JOB_NAME, RIGHT_CUT, spanOf, SPINDLE_RPM, WRONG_CUTS } from "../src/learn/cuts.js";
import { cellsOf, COLUMNS } from "../src/learn/cells.js";
import { hear, type Heard } from "../src/learn/measure.js";
import { Round, shuffled } from "../src/learn/quiz.js";

const ALL = [RIGHT_CUT, ...WRONG_CUTS];

describe("what is heard", () => {
  const tone = (hz: number, amplitude: number) =>
    Float32Array.from({ length: RATE }, (_, n) => amplitude * Math.sin((2 * Math.PI * hz * n) / RATE));
  const sum = (...all: Float32Array[]) => all[0]!.map((_, n) => all.reduce((value, one) => value + one[n]!, 0));
  const db = (amplitude: number) => 20 * Math.log10(amplitude / Math.SQRT2);

  it("is the levels of the tones, whichever they are", () => {
    const heard = hear(sum(tone(300, 0.2), tone(600, 0.1), tone(200, 0.05), tone(2345, 0.02)), RATE, 100, 3);
    expect(heard.teeth_db).toBeCloseTo(db(Math.hypot(0.2, 0.1)), 1);
    expect(heard.turn_db).toBeCloseTo(db(0.05), 1);
    expect(heard.tone_db).toBeCloseTo(db(0.02), 1);
    expect(Math.abs(heard.tone_hz - 2345)).toBeLessThan(RATE / 16384);
    expect(heard.level_db).toBeCloseTo(db(Math.hypot(0.2, 0.1, 0.05, 0.02)), 1);
    expect(cellsOf(heard)[4]).toMatch(/^-\d/);
  });
  it("is no tone in noise", () => {
    let state = 1;
    const noise = Float32Array.from({ length: 3 * RATE }, () => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return 0.05 * (state / 2 ** 31 - 1);
    });
    const heard = hear(noise, RATE, 100, 3);
    // Even over all frequencies: above 5 kHz are 19 of 24 parts.
    expect(heard.hiss_db - heard.level_db).toBeCloseTo(10 * Math.log10(19 / 24), 1);
    expect(cellsOf(heard).slice(1, 4)).toEqual(["none", "none", "none"]);
  });
});

describe("the cuts of the quiz", () => {
  const heard = new Map<string, Heard>();
  const levels: number[] = [];

  beforeAll(async () => {
    for (const cut of ALL) {
      const ear = await load<MillSoundExports>("mill_sound");
      ear.sound_open(RATE);
      const mill = await load<MillExports>("tribo");
      openFiles(mill, filesOf(cut), JOB_NAME);
      const clip = clipOf(mill, ear, spanOf(cut));
      heard.set(cut.id, hear(clip[0], RATE, SPINDLE_RPM / 60, FLUTES));
      levels.push(clip[0].reduce((most, v) => Math.max(most, Math.abs(v)), 0));
    }
  }, PATIENCE_MS);

  it("are milled by the engine, and none is bent by the limiter", () => {
    expect(heard.size).toBe(8);
    for (const level of levels) expect(level).toBeLessThan(0.9);
  });

  // Against the right cut, dB. What is not named may be as it is.
  const off = (id: string, key: keyof Heard) => heard.get(id)![key] - heard.get("right")![key];
  it("differ from the right one in what the explanation says", () => {
    expect(off("feed", "teeth_db")).toBeGreaterThan(3);
    expect(off("feed", "hiss_db")).toBeGreaterThan(4);
    expect(off("stickout", "tone_db")).toBeGreaterThan(12);
    expect(heard.get("stickout")!.tone_hz).toBeLessThan(heard.get("chatter")!.tone_hz - 300);
    expect(off("rubbing", "teeth_db")).toBeLessThan(-8);
    expect(off("rubbing", "hiss_db")).toBeLessThan(-6);
    expect(off("runout", "turn_db")).toBeGreaterThan(12);
    expect(off("conventional", "teeth_db")).toBeLessThan(-2);
    expect(off("conventional", "tone_db")).toBeGreaterThan(10);
    expect(off("chatter", "tone_db")).toBeGreaterThan(18);
    expect(heard.get("chatter")!.tone_db).toBeGreaterThan(heard.get("chatter")!.teeth_db - 4);
    expect(off("dull", "teeth_db")).toBeGreaterThan(5);
    expect(Math.abs(off("dull", "hiss_db"))).toBeLessThan(1);
  });
  it("differ from each other by 2 dB in at least one of the five", () => {
    const keys = ["level_db", "teeth_db", "turn_db", "tone_db", "hiss_db"] as const;
    const ids = ALL.map(({ id }) => id);
    for (const [n, a] of ids.entries())
      for (const b of ids.slice(n + 1)) {
        const most = Math.max(...keys.map((key) => Math.abs(heard.get(a)![key] - heard.get(b)![key])));
        expect(most, `${a} and ${b}`).toBeGreaterThan(2);
      }
  });
  it("are in the table of the documentation as they are measured", () => {
    const rows = ALL.map(({ id, name }) => `| ${[name, ...cellsOf(heard.get(id)!)].join(" | ")} |`);
    const table = [`| cut | ${COLUMNS.join(" | ")} |`, `|${"---|".repeat(COLUMNS.length + 1)}`, ...rows].join("\n");
    expect(readFileSync(join(ROOT, "docs/mill-page.md"), "utf8")).toContain(table);
  });
});

describe("a round", () => {
  it("asks each cut once, in an order that tells nothing", () => {
    const places = new Map<string, number>();
    for (let n = 0; n < 7000; ++n) {
      const [first] = shuffled(WRONG_CUTS, Math.random);
      places.set(first!.id, (places.get(first!.id) ?? 0) + 1);
    }
    // A thousand each; five standard deviations.
    for (const { id } of WRONG_CUTS) expect(Math.abs(places.get(id)! - 1000)).toBeLessThan(150);
    expect(new Set(new Round(WRONG_CUTS).cuts).size).toBe(7);
  });
  it("counts the first answers alone", () => {
    const round = new Round(WRONG_CUTS.slice(0, 2), () => 0);
    const [first, second] = round.cuts;
    round.next();
    expect([round.number, round.answered, round.cut]).toEqual([1, false, first]);
    expect(round.answer(second!.id)).toBe(false);
    expect(round.answer(first!.id)).toBe(false);
    round.next();
    expect(round.answer(second!.id)).toBe(true);
    round.next();
    expect([round.cut, round.score, round.answers]).toEqual([undefined, 1, [second!.id, second!.id]]);
  });
});

describe.runIf(hasMillPage)("the quiz", () => {
  let mill: MillPage;
  let page: Page;
  const asked: string[] = [];

  beforeAll(async () => {
    mill = await MillPage.open();
    ({ page } = mill);
  }, PATIENCE_MS);

  afterAll(() => mill?.close());

  const ready = () => page.waitForSelector("#quiz-this:not([disabled])", { timeout: PATIENCE_MS });
  /** All that the page holds while it asks, but for the number of the question and the score. */
  const held = () =>
    page.evaluate(() => {
      const all = document.documentElement.cloneNode(true) as HTMLElement;
      all.querySelector("#quiz-count")!.textContent = "";
      // The mill behind it goes on.
      const own = all.querySelector("#quiz")!.outerHTML;
      return { own, title: document.title, address: location.href };
    });

  it(
    "is loaded when it is opened, and not before",
    async () => {
      const learned = () => mill.loaded.filter(({ url }) => /\/learn/.test(url)).length;
      expect(learned()).toBe(0);
      await page.waitForSelector("#learn-begin:not([hidden])");
      await page.click("#learn-begin");
      await page.waitForSelector("#quiz[open]", { timeout: PATIENCE_MS });
      await expect.poll(learned, { timeout: PATIENCE_MS }).toBe(3);
      await mill.picture("quiz-begins");
      await ready();
      expect(await violations(page)).toEqual([]);
      await mill.picture("quiz-asks");
    },
    PATIENCE_MS,
  );

  it(
    "plays the right cut and this one, one at a time",
    async () => {
      const level = () =>
        page.evaluate(() => {
          const { meter } = window as unknown as { meter?: AnalyserNode };
          const samples = new Float32Array(2048);
          meter?.getFloatTimeDomainData(samples);
          return Math.hypot(...samples) / Math.sqrt(samples.length);
        });
      for (const [id, other] of [
        ["quiz-right", "quiz-this"],
        ["quiz-this", "quiz-right"],
      ]) {
        await page.click(`#${id}`);
        expect(await page.getAttribute(`#${id}`, "aria-pressed")).toBe("true");
        expect(await page.getAttribute(`#${other}`, "aria-pressed")).toBe("false");
        await expect.poll(level, { timeout: PATIENCE_MS, interval: 20 }).toBeGreaterThan(0.01);
      }
      // It ends by itself.
      await page.waitForSelector('#quiz-this[aria-pressed="false"]', { timeout: PATIENCE_MS });
    },
    PATIENCE_MS,
  );

  it(
    "does not tell what it asks, and explains it afterwards",
    async () => {
      const faults: string[] = [];
      let before: unknown;
      const requests: string[] = [];
      page.on("request", (request) => requests.push(request.url()));
      for (let n = 1; n <= 7; ++n) {
        await ready();
        expect(await mill.text("quiz-count")).toMatch(new RegExp(`^Cut ${n} of 7`));
        const now = await held();
        expect(now).toEqual((before ??= now));
        expect(await page.locator("#quiz-answers button").allTextContents()).toEqual(WRONG_CUTS.map((c) => c.name));
        await page.click(`#quiz-answers button:nth-child(${n})`);
        const verdict = await mill.text("quiz-verdict");
        const cut = WRONG_CUTS.find(({ name }) => verdict.includes(name))!;
        expect(verdict.startsWith("Right")).toBe(cut === WRONG_CUTS[n - 1]);
        expect(await mill.text("quiz-why")).toBe(cut.why);
        expect(await page.locator("#quiz-heard tr").count()).toBe(6);
        faults.push(...(await violations(page)));
        if (n === 1) await mill.picture("quiz-tells");
        asked.push(cut.id);
        await page.click("#quiz-next");
      }
      expect(new Set(asked).size).toBe(7);
      // Nor does what is fetched.
      expect(requests).toEqual([]);
      expect(faults).toEqual([]);
    },
    2 * PATIENCE_MS,
  );

  it(
    "ends with the score, and plays all again by name",
    async () => {
      const right = asked.filter((id, n) => id === WRONG_CUTS[n]!.id).length;
      expect(await mill.text("quiz-score")).toBe(`${right} of 7 right`);
      expect(await page.locator("#quiz-all tr").count()).toBe(9);
      await page.click("#quiz-hear-dull");
      expect(await page.getAttribute("#quiz-hear-dull", "aria-pressed")).toBe("true");
      await page.click("#quiz-hear-dull");
      expect(await page.getAttribute("#quiz-hear-dull", "aria-pressed")).toBe("false");
      expect(await violations(page)).toEqual([]);
      await mill.picture("quiz-ends");
    },
    PATIENCE_MS,
  );

  it(
    "is worked by keys, asks anew, and puts a cut on the bench",
    async () => {
      await page.focus("#quiz-again");
      await page.keyboard.press("Enter");
      expect(await page.evaluate(() => document.activeElement?.id)).toBe("quiz-this");
      await page.keyboard.press("Tab");
      await page.keyboard.press("Space");
      expect(await page.evaluate(() => document.activeElement?.id)).toBe("quiz-verdict");
      const name = (await mill.text("quiz-verdict")).replace(/^Right: |^No, it was: |\.$/g, "");
      const { parts } = WRONG_CUTS.find((cut) => cut.name === name)!;
      await page.click("#quiz-mill");
      await mill.until("cut.toml", "job");
      expect(await page.isVisible("#quiz")).toBe(false);
      await page.click("#show-panel");
      await expect.poll(() => page.inputValue("#job-text"), { timeout: PATIENCE_MS }).toBe(parts.job);
      await page.click("#learn");
      await page.waitForSelector("#quiz[open]");
      await page.keyboard.press("Escape");
      await page.waitForSelector("#quiz", { state: "hidden" });
    },
    PATIENCE_MS,
  );

  it(
    "fits a phone, light and dark",
    async () => {
      await page.setViewportSize({ width: 390, height: 844 });
      await page.waitForSelector("#theme");
      for (const theme of ["light", "dark"]) {
        await page.selectOption("#theme", theme);
        await page.click("#learn");
        await page.waitForSelector("#quiz[open]");
        expect(await violations(page)).toEqual([]);
        await mill.picture(`quiz-phone-${theme}`);
        const wide = await page.evaluate(() => document.getElementById("quiz")!.scrollWidth);
        expect(wide).toBeLessThanOrEqual(390);
        await page.click("#quiz-close");
      }
    },
    PATIENCE_MS,
  );

  it("says so where the cuts cannot be milled", async () => {
    const visitor = await mill.browser.newPage({ reducedMotion: "reduce" });
    await visitor.goto(`${mill.server.root}/mill/`);
    await visitor.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
    await visitor.route("**/mill_sound.wasm", (route) => route.abort());
    await visitor.click("#learn-begin");
    await visitor.waitForFunction(
      () => document.getElementById("quiz-count")?.textContent?.includes("The cuts cannot be milled here"),
      null,
      { timeout: PATIENCE_MS },
    );
    expect(await visitor.isDisabled("#quiz-this")).toBe(true);
    await visitor.close();
  });

  it("makes no error", () => {
    expect(mill.foreign).toEqual([]);
    expect(mill.problems).toEqual([]);
  });
});

// SPDX-License-Identifier: MIT
// The page with the engine behind it: `tribo live` in headless Chromium.
import type { ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { file, hasBrowser, launch, PATIENCE_MS } from "../../testing/browser.js";
import { jobText } from "../../testing/job.js";
import { startLive } from "../../testing/live.js";
import { feelAt } from "../../testing/mill_page.js";
import { PROGRAM } from "../../tools/places.js";

const JOB = jobText("[[0, 0, -8], [40, 20, 0]]");
// Two grooves, then a rapid through what is left between.
const PROGRAM_TEXT = "G21 G90\nG0 X-5 Y5 Z5\nG1 Z-2\nG1 X45\nG0 Z5\nG0 Y9 X-5\nG1 Z-2\nG1 X45\nG0 Y16 X20\n";

const start = (folder: string, port = "0") =>
  startLive(join(folder, "job.toml"), "--port", port, "--resolution", "0.5", "--uncertain", "20");

describe.runIf(hasBrowser && existsSync(PROGRAM))("the live page", () => {
  let folder: string;
  let engine: ChildProcess;
  let browser: Browser;
  let page: Page;
  const problems: string[] = [];
  const foreign: string[] = [];

  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "tribo-live-"));
    writeFileSync(join(folder, "job.toml"), JOB);
    writeFileSync(join(folder, "p.nc"), PROGRAM_TEXT);
    const started = await start(folder);
    engine = started.engine;
    browser = await launch();
    page = await browser.newPage({ viewport: { width: 800, height: 600 } });
    page.on("pageerror", (error) => problems.push(error.message));
    page.on("request", (request) => {
      const asked = new URL(request.url());
      if (asked.protocol !== "data:" && asked.host !== new URL(started.url).host) foreign.push(request.url());
    });
    await page.goto(started.url);
    await page.waitForFunction(() => document.getElementById("clock")?.textContent?.includes("/ 0:"));
  }, PATIENCE_MS);

  afterAll(async () => {
    await browser?.close();
    engine?.kill("SIGINT");
    rmSync(folder, { recursive: true, force: true });
  });

  const removed = async () => parseFloat((await page.textContent("#removed")) ?? "");
  const until = (text: string, id: string) =>
    page.waitForFunction(
      ([want, where]) => document.getElementById(where)?.textContent?.includes(want),
      [text, id] as const,
      { timeout: PATIENCE_MS },
    );

  it(
    "mills while it plays and stops where it is paused",
    async () => {
      expect(await removed()).toBe(0);
      expect(await page.textContent("#case-count")).toBe("20 cases");
      // A slow machine must not be at the end before it pauses.
      await page.selectOption("#speed", "0.1");
      await page.click("#play");
      await until("Pause", "play");
      await page.waitForFunction(
        () => parseFloat(document.getElementById("removed")?.textContent ?? "0") > 0.02,
        null,
        {
          timeout: PATIENCE_MS,
        },
      );
      await page.click("#play");
      await until("Play", "play");
      const clock = await page.textContent("#clock");
      await page.waitForTimeout(300);
      expect(await page.textContent("#clock")).toBe(clock);
    },
    PATIENCE_MS,
  );

  it(
    "goes to where the timeline is set, back as well as forth",
    async () => {
      await page.fill("#time", "0.1");
      await until("0.00", "removed");
      await page.fill("#time", "1000");
      await page.waitForFunction(() => parseFloat(document.getElementById("removed")?.textContent ?? "0") > 0.5, null, {
        timeout: PATIENCE_MS,
      });
    },
    PATIENCE_MS,
  );

  it(
    "lists the rapid that ran through stock, with its line",
    async () => {
      await until("line 9: rapid through stock", "collisions");
    },
    PATIENCE_MS,
  );

  it(
    "draws the part",
    async () => {
      const colours = new Set<number>();
      const picture = await page.locator("#scene").screenshot();
      for (const byte of picture) colours.add(byte);
      expect(picture.length).toBeGreaterThan(5000);
      expect(colours.size).toBeGreaterThan(200);
    },
    PATIENCE_MS,
  );

  it(
    "is worked by the keyboard",
    async () => {
      await page.focus("#scene");
      await page.keyboard.press("Space");
      await until("Pause", "play");
      await page.keyboard.press("Space");
      await until("Play", "play");
    },
    PATIENCE_MS,
  );

  it(
    "lets the part be felt, tells how the servo does, and stops it",
    async () => {
      const box = (await page.locator("#stage").boundingBox())!;
      await feelAt(page, box.x + 0.5 * box.width, box.y + 0.62 * box.height);
      await page.mouse.move(box.x + 0.51 * box.width, box.y + 0.62 * box.height, { steps: 4 });
      await page.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "0") > 0.05, null, {
        timeout: PATIENCE_MS,
      });
      await page.mouse.up();
      await page.click("#show-panel");
      await page.waitForSelector("#servo:not([hidden])", { timeout: PATIENCE_MS });
      expect(await page.textContent("#servo")).toContain("1000 Hz");
      await page.click("#stop");
      await until("Release", "stop");
      await page.click("#stop");
      await until("Stop", "stop");
      await page.focus("#set-feed_percent");
      await page.keyboard.press("Home");
      await until("10 %", "parameters");
      await page.click("#show-panel");
    },
    PATIENCE_MS,
  );

  it(
    "is felt by a pen as hard as it presses, and by a gamepad",
    async () => {
      const box = (await page.locator("#stage").boundingBox())!;
      const at = { x: box.x + 0.5 * box.width, y: box.y + 0.62 * box.height };
      const hand = await page.context().newCDPSession(page);
      const pen = (type: "mousePressed" | "mouseMoved" | "mouseReleased", force: number, x = at.x) =>
        hand.send("Input.dispatchMouseEvent", {
          type,
          ...at,
          x,
          button: "left",
          buttons: type === "mouseReleased" ? 0 : 1,
          clickCount: 1,
          pointerType: "pen",
          force,
        });
      const felt = async () => parseFloat((await page.textContent("#felt")) ?? "0");
      const settled = async (force: number) => {
        for (let n = 0; n < 12; ++n) {
          await pen("mouseMoved", force, at.x + (n % 2));
          await page.waitForTimeout(50);
        }
        return felt();
      };
      // The picture may still move to the room that a closing panel leaves: a press beside the part is made again.
      await expect
        .poll(
          async () => {
            await pen("mouseReleased", 0);
            await pen("mousePressed", 0.2);
            return page.getAttribute("#scene", "class");
          },
          { timeout: PATIENCE_MS / 2 },
        )
        .toContain("touching");
      let light = 0;
      await expect.poll(async () => (light = await settled(0.2)), { timeout: PATIENCE_MS / 2 }).toBeGreaterThan(0.02);
      const firm = await settled(0.8);
      await pen("mouseReleased", 0);
      expect(firm).toBeGreaterThan(2 * light);
      await page.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "1") === 0, null, {
        timeout: PATIENCE_MS,
      });
      const pad = (trigger: number) =>
        page.evaluate((value) => {
          const buttons = Array.from({ length: 8 }, (_, n) => ({
            pressed: n === 7 && value > 0,
            touched: false,
            value: n === 7 ? value : 0,
          }));
          navigator.getGamepads = () => [{ connected: true, axes: [0, 0], buttons } as unknown as Gamepad];
        }, trigger);
      await pad(1);
      await page.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "0") > 0.05, null, {
        timeout: PATIENCE_MS,
      });
      await pad(0);
      await page.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "1") === 0, null, {
        timeout: PATIENCE_MS,
      });
      await page.evaluate(() => (navigator.getGamepads = () => []));
    },
    PATIENCE_MS,
  );

  it(
    "is felt by a touch",
    async () => {
      const context = await browser.newContext({ viewport: { width: 800, height: 600 }, hasTouch: true });
      const tablet = await context.newPage();
      await tablet.goto(page.url());
      await tablet.waitForFunction(() => document.getElementById("clock")?.textContent?.includes("/ 0:"));
      const box = (await tablet.locator("#stage").boundingBox())!;
      const hand = await context.newCDPSession(tablet);
      const touch = (type: "touchStart" | "touchMove" | "touchEnd", x?: number) =>
        hand.send("Input.dispatchTouchEvent", {
          type,
          touchPoints:
            x === undefined
              ? []
              : [{ x: box.x + x * box.width, y: box.y + 0.62 * box.height, radiusX: 8, radiusY: 8, force: 0.5 }],
        });
      await touch("touchStart", 0.5);
      await tablet.waitForSelector("#scene.touching", { timeout: PATIENCE_MS });
      for (let n = 0; n < 8; ++n) {
        await touch("touchMove", 0.5 + 0.005 * (n % 2));
        await tablet.waitForTimeout(50);
      }
      await tablet.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "0") > 0.05, null, {
        timeout: PATIENCE_MS,
      });
      await touch("touchEnd");
      await tablet.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "1") === 0, null, {
        timeout: PATIENCE_MS,
      });
      await context.close();
    },
    PATIENCE_MS,
  );

  it(
    "shows every state with the next picture",
    async () => {
      const other = await browser.newPage({ viewport: { width: 400, height: 300 } });
      await other.addInitScript(() => {
        const told: number[] = [];
        const late: number[] = [];
        let pictures = 0;
        const count = () => requestAnimationFrame(() => (++pictures, count()));
        count();
        window.WebSocket = class extends WebSocket {
          constructor(url: string | URL, protocols?: string | string[]) {
            super(url, protocols);
            this.addEventListener("message", ({ data }) => {
              if (data instanceof ArrayBuffer && new Uint8Array(data)[0] === 3) told.push(pictures);
            });
          }
        };
        const draw = WebGL2RenderingContext.prototype.drawElements;
        WebGL2RenderingContext.prototype.drawElements = function (...all) {
          for (const at of told.splice(0)) late.push(pictures - at);
          draw.apply(this, all);
        };
        Object.assign(window, { late });
      });
      await other.goto(page.url());
      await other.waitForFunction(() => document.getElementById("clock")?.textContent?.includes("/ 0:"));
      await other.click("#play");
      await other.waitForFunction(() => (window as unknown as { late: number[] }).late.length > 40, null, {
        timeout: PATIENCE_MS,
      });
      const late = await other.evaluate(() => (window as unknown as { late: number[] }).late);
      await other.click("#play");
      await until("Play", "play");
      await other.close();
      // Pictures between a state's coming and its being drawn; the first ones wait for the part.
      expect(Math.max(...late.slice(5))).toBeLessThanOrEqual(1);
    },
    PATIENCE_MS,
  );

  it(
    "says what is wrong with a file, and where, until it is good again",
    async () => {
      const stepBack = async () => {
        await page.fill("#time", "1000");
        await page.waitForFunction(
          () => {
            const [at, end] = document.getElementById("clock")!.textContent.split(" / ");
            return at === end;
          },
          null,
          { timeout: PATIENCE_MS },
        );
        await page.fill("#time", "0");
      };
      writeFileSync(join(folder, "p.nc"), PROGRAM_TEXT.replace("G1 Z-2", "G1 Zx-2"));
      await stepBack();
      await page.waitForSelector("#file-fault:not([hidden])", { timeout: PATIENCE_MS });
      expect(await page.textContent("#file-fault")).toMatch(/p\.nc:3(:\d+)?: .*; the cut before goes on$/);
      writeFileSync(join(folder, "p.nc"), PROGRAM_TEXT);
      await stepBack();
      await page.waitForSelector("#file-fault", { state: "hidden", timeout: PATIENCE_MS });
    },
    PATIENCE_MS,
  );

  it(
    "comes back by a token that is good for once, with the part as it is",
    async () => {
      const other = await browser.newPage({ viewport: { width: 400, height: 300 } });
      await other.addInitScript(() => {
        // Those over which something was said: the first words bring the token.
        const lines: WebSocket[] = [];
        window.WebSocket = class extends WebSocket {
          constructor(url: string | URL, protocols?: string | string[]) {
            super(url, protocols);
            this.addEventListener("message", () => setTimeout(() => lines.push(this)), { once: true });
          }
        };
        Object.assign(window, { lines });
      });
      await other.goto(page.url());
      await other.waitForFunction(() => (window as unknown as { lines: WebSocket[] }).lines.length === 1, null, {
        timeout: PATIENCE_MS,
      });
      await other.waitForFunction(() => document.getElementById("clock")?.textContent?.includes("/ 0:"));
      const removedThere = () => other.textContent("#removed");
      const before = await removedThere();
      for (const round of [1, 2]) {
        await other.evaluate((n) => (window as unknown as { lines: WebSocket[] }).lines[n - 1]!.close(), round);
        await other.waitForFunction((n) => (window as unknown as { lines: WebSocket[] }).lines.length > n, round, {
          timeout: PATIENCE_MS,
        });
      }
      const urls = await other.evaluate(() =>
        (window as unknown as { lines: WebSocket[] }).lines.map((line) => line.url),
      );
      const tokens = urls.map((url) => new URL(url).searchParams.get("resume"));
      expect(tokens[0]).toBeNull();
      expect(tokens[1]).toMatch(/^\S{16,}$/);
      expect(tokens[2]).toMatch(/^\S{16,}$/);
      expect(tokens[2]).not.toBe(tokens[1]);
      await other.waitForSelector("#notice-box", { state: "hidden", timeout: PATIENCE_MS });
      expect(await removedThere()).toBe(before);
      await other.close();
    },
    PATIENCE_MS,
  );

  it(
    "gives the moment of a dropped job as a file, and has the quiz",
    async () => {
      const other = await browser.newPage({ viewport: { width: 800, height: 600 } });
      other.on("pageerror", (error) => problems.push(error.message));
      await other.goto(page.url());
      await other.waitForFunction(() => document.getElementById("clock")?.textContent?.includes("/ 0:"));
      expect(await other.isVisible("#learn-begin")).toBe(false);
      await other.click("#show-panel");
      expect(await other.isVisible("#keep-link")).toBe(false);
      await other.setInputFiles("#files", [file("mine.toml", JOB), file("p.nc", PROGRAM_TEXT)]);
      await other.waitForSelector("#keep-link:visible", { timeout: PATIENCE_MS });
      // The first picture of it tells the time.
      await other.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
      const [download] = await Promise.all([other.waitForEvent("download"), other.click("#keep-link")]);
      expect(download.suggestedFilename()).toBe("mine 0-00.moment");
      expect(await other.textContent("#link-said")).toContain("a page without an engine");
      expect(await other.isVisible("#link")).toBe(false);
      await other.click("#learn");
      await other.waitForSelector("#quiz-this:not([disabled])", { timeout: PATIENCE_MS });
      await other.close();
    },
    PATIENCE_MS,
  );

  it("asks nobody else and makes no error", () => {
    expect(foreign).toEqual([]);
    expect(problems).toEqual([]);
  });

  it(
    "says when the engine has gone",
    async () => {
      engine.kill("SIGINT");
      await page.waitForSelector("#notice-box:not([hidden])", { timeout: PATIENCE_MS });
      expect(await page.textContent("#notice")).toContain("No line to the engine");
      // A new one on the same port is found.
      engine = (await start(folder, new URL(page.url()).port)).engine;
      await page.waitForSelector("#notice-box", { state: "hidden", timeout: PATIENCE_MS });
      await until("0.00", "removed");
    },
    PATIENCE_MS,
  );
});

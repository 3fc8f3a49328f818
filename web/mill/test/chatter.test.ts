// SPDX-License-Identifier: MIT
// A cut that chatters in the page without an engine, in headless Chromium: verdict, chart, colours, and a better speed.
import { existsSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { violations } from "../../testing/axe.js";
import { file, hasBrowser, launch, PATIENCE_MS } from "../../testing/browser.js";
import { BENDING_SLOT, jobText, SLOT_PROGRAM } from "../../testing/job.js";
import { serveFolder, type Server } from "../../testing/server.js";
import { SITE } from "../../tools/places.js";

const PICTURES = process.env.TRIBO_PICTURES;

describe.runIf(hasBrowser && existsSync(join(SITE, "mill/index.html")))("a cut that chatters in the page", () => {
  let server: Server;
  let browser: Browser;
  let page: Page;
  const problems: string[] = [];

  beforeAll(async () => {
    server = await serveFolder(SITE);
    browser = await launch();
    page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
    page.on("pageerror", (error) => problems.push(error.message));
    // Not the first visit, which begins with the film.
    await page.addInitScript(() => localStorage.setItem("tribo.film", "seen"));
    await page.goto(`${server.root}/mill/`);
    await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
  }, PATIENCE_MS);

  afterAll(async () => {
    await browser?.close();
    await server?.close();
  });

  const until = (want: string, id: string) =>
    page.waitForFunction(
      ([w, where]) => document.getElementById(where)?.textContent?.includes(w),
      [want, id] as const,
      { timeout: PATIENCE_MS },
    );
  const picture = async (name: string) => {
    if (PICTURES) await page.screenshot({ path: join(PICTURES, `${name}.png`) });
  };
  // Colours of the pixels of a canvas: how many have each of some hues.
  const chartPixels = () =>
    page.evaluate(() => {
      const canvas = document.getElementById("chatter-chart") as HTMLCanvasElement;
      const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
      const count = { unstable: 0, chatters: 0, stable: 0 };
      for (let n = 0; n < data.length; n += 4) {
        const [r, g, b] = [data[n]!, data[n + 1]!, data[n + 2]!];
        if (r === 140 && g === 64 && b === 66) ++count.unstable;
        if (r === 209 && g === 26 && b === 26) ++count.chatters;
        if (r === 0 && g === 115 && b === 77) ++count.stable;
      }
      return count;
    });

  it(
    "is said to chatter, at which frequency, and coloured by it",
    async () => {
      await page.setInputFiles("#files", [file("slot.toml", BENDING_SLOT), file("slot.nc", SLOT_PROGRAM)]);
      await until("slot.toml", "job");
      await page.selectOption("#speed", "0.1");
      await page.click("#begin");
      await until("chatters at 969 Hz", "chatter-verdict");
      expect(Number(await page.textContent("#chatter-number"))).toBeCloseTo(1.139, 2);
      expect(await page.inputValue("#colouring")).toBe("chatter");
      await until("near the limit", "legend-marks");
      await page.waitForSelector("#chatter-best:not([hidden])", { timeout: PATIENCE_MS });
      // The chart grows finer for a while.
      await expect.poll(async () => (await chartPixels()).unstable, { timeout: PATIENCE_MS }).toBeGreaterThan(400);
      const seen = await chartPixels();
      expect(seen.chatters).toBeGreaterThan(30);
      expect(seen.stable).toBe(0);
      await picture("chatter");
      expect(await violations(page)).toEqual([]);
    },
    PATIENCE_MS,
  );

  it(
    "gets stable at the speed that the chart recommends",
    async () => {
      await page.fill("#time", "1.5");
      await page.click("#chatter-best");
      await page.waitForFunction(() => !document.getElementById("spindle")?.textContent?.startsWith("8000"), null, {
        timeout: PATIENCE_MS,
      });
      await until("stable", "chatter-verdict");
      expect(Number(await page.textContent("#chatter-number"))).toBeLessThan(1);
      await expect.poll(async () => (await chartPixels()).stable, { timeout: PATIENCE_MS }).toBeGreaterThan(30);
      expect((await chartPixels()).chatters).toBe(0);
      await picture("chatter_stable");
    },
    PATIENCE_MS,
  );

  it(
    "turns the spindle at a speed that is clicked",
    async () => {
      const box = (await page.locator("#chatter-chart").boundingBox())!;
      const before = await page.textContent("#spindle");
      await page.mouse.click(box.x + 0.2 * box.width, box.y + 0.5 * box.height);
      await page.waitForFunction((was) => document.getElementById("spindle")?.textContent !== was, before, {
        timeout: PATIENCE_MS,
      });
    },
    PATIENCE_MS,
  );

  it(
    "is readable on a phone",
    async () => {
      await page.setViewportSize({ width: 390, height: 844 });
      await page.waitForTimeout(500);
      await picture("chatter_phone");
      const chart = (await page.locator("#chatter").boundingBox())!;
      const now = (await page.locator("#now").boundingBox())!;
      expect(chart.x).toBeGreaterThanOrEqual(now.x + now.width);
      expect(chart.x + chart.width).toBeLessThanOrEqual(390);
      await page.setViewportSize({ width: 1440, height: 900 });
    },
    PATIENCE_MS,
  );

  it(
    "shows nothing of it for a job in which nothing bends",
    async () => {
      await page.setInputFiles("#files", [
        file("job.toml", jobText("[[0, 0, -6], [30, 16, 0]]")),
        file("p.nc", "G21 G90\nG0 X-5 Y5 Z5\nG1 Z-2\nG1 X35\n"),
      ]);
      await until("job.toml", "job");
      await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
      expect(await page.isVisible("#chatter")).toBe(false);
      expect(await page.locator("#chatter-colouring").isHidden()).toBe(true);
      expect(problems).toEqual([]);
    },
    PATIENCE_MS,
  );
});

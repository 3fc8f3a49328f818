// SPDX-License-Identifier: MIT
// compare.html as `tribo compare` writes it, opened as a file: two views, one camera, one place, two sounds.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { hasBrowser, launch, launchWithoutGraphics, PATIENCE_MS } from "../../testing/browser.js";
import { jobText } from "../../testing/job.js";
import { coloursOf, watch } from "../../testing/offline_page.js";
import { PROGRAM } from "../../tools/places.js";

const JOB = jobText("[[0, 0, -8], [40, 20, 0]]", "");
const program = (depth: number, feed: number) =>
  `G21 G90 F${feed}\nG0 X-5 Y5 Z5\nG1 Z-2\nG1 X45\nG0 Z5\nG0 Y13 X-5\nG1 Z-${depth}\nG1 X45\n`;

describe.runIf(hasBrowser && existsSync(PROGRAM))("the page of a comparison", () => {
  let folder: string;
  let browser: Browser;
  let page: Page;
  let asked: string[];
  let problems: string[];
  let address: string;

  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "tribo-compare-"));
    for (const [name, text] of [
      ["a", program(2, 600)],
      ["b", program(3, 300)],
    ] as const) {
      writeFileSync(join(folder, `${name}.toml`), JOB.replace("p.nc", `${name}.nc`));
      writeFileSync(join(folder, `${name}.nc`), text);
    }
    const jobs = ["a.toml", "b.toml"].map((name) => join(folder, name));
    execFileSync(PROGRAM, ["compare", ...jobs, "--out", join(folder, "out"), "--resolution", "0.25"]);
    address = pathToFileURL(join(folder, "out/compare.html")).href;
    browser = await launch();
    page = await browser.newPage({ viewport: { width: 900, height: 700 } });
    ({ asked, problems } = watch(page));
    // Counts what the page does with sounds.
    await page.addInitScript(() => {
      const counts = { starts: 0, stops: 0, jumps: 0, fades: 0 };
      Object.assign(window, { counts });
      const spy = <T extends object, K extends keyof T>(of: T, name: K, count: () => void) => {
        const real = of[name] as (...given: unknown[]) => unknown;
        of[name] = function (this: unknown, ...given: unknown[]) {
          count();
          return real.apply(this, given);
        } as T[K];
      };
      spy(AudioBufferSourceNode.prototype, "start", () => ++counts.starts);
      spy(AudioBufferSourceNode.prototype, "stop", () => ++counts.stops);
      spy(AudioParam.prototype, "setTargetAtTime", () => ++counts.fades);
      spy(AudioParam.prototype, "setValueAtTime", () => ++counts.jumps);
    });
    await page.goto(address);
    await page.waitForFunction(() => document.querySelectorAll(".live:not([hidden])").length === 2);
  }, PATIENCE_MS);

  afterAll(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  const view = (side: string) => coloursOf(page, `#view-${side} canvas`);
  const read = (side: string) => page.textContent(`#view-${side} .readout`);

  it("is one file that asks for nothing else", () => {
    expect(asked.filter((url) => !url.startsWith("data:"))).toEqual([address]);
    expect(statSync(join(folder, "out/compare.html")).size).toBeLessThan(8e6);
    expect(problems).toEqual([]);
  });

  it("shows where B cuts deeper on both parts, and nowhere more material", async () => {
    for (const side of ["a", "b"]) {
      const seen = await view(side);
      expect(seen.drawn).toBeGreaterThan(10_000);
      expect(seen.orange).toBeGreaterThan(1000);
      expect(seen.purple).toBe(0);
    }
    await page.check('#part-colour input[value="surface"]');
    // The mark at the tip remains.
    expect((await view("b")).orange).toBeLessThan(100);
    await page.check('#part-colour input[value="deviation"]');
  });

  it("turns both views together", async () => {
    const before = [(await view("a")).sum, (await view("b")).sum];
    await page.focus("#view-a canvas");
    await page.keyboard.press("ArrowLeft");
    expect((await view("a")).sum).not.toBe(before[0]);
    expect((await view("b")).sum).not.toBe(before[1]);
    await page.focus("#view-b canvas");
    await page.keyboard.press("ArrowRight");
    expect([(await view("a")).sum, (await view("b")).sum]).toEqual(before);
  });

  it(
    "moves both runs to the same line",
    async () => {
      const last = await page.getAttribute("#place", "max");
      for (const place of ["0", last!]) {
        await page.fill("#place", place);
        const line = /line (\d+)/.exec((await read("a"))!)![1];
        expect(await read("b")).toContain(`line ${line} `);
      }
      const before = await read("a");
      await page.fill("#place", "0");
      await page.click("#play");
      await page.waitForFunction((text) => document.querySelector("#view-a .readout")!.textContent === text, before, {
        timeout: PATIENCE_MS,
      });
    },
    2 * PATIENCE_MS,
  );

  it("draws each lane with its difference", async () => {
    const painted = (id: string) =>
      page.evaluate((name) => {
        const canvas = document.querySelector<HTMLCanvasElement>(`#${name}`)!;
        const bytes = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height).data;
        let sum = 0;
        for (let n = 0; n < bytes.length; n += 4) if (bytes[n + 3]! > 0) sum += bytes[n]! + (n % 1009);
        return sum;
      }, id);
    const lanes = await page.locator("#lane-choice input").count();
    expect(lanes).toBeGreaterThan(6);
    const sums = new Set<number>();
    for (let n = 0; n < lanes; ++n) {
      await page.locator("#lane-choice input").nth(n).check();
      sums.add(await painted("lane-plot"));
    }
    expect(sums.size).toBe(lanes);
    expect(await painted("difference-plot")).toBeGreaterThan(10_000);
  });

  it(
    "switches the sound by a fade: no source stops or starts",
    async () => {
      const counts = () => page.evaluate(() => (window as unknown as { counts: Record<string, number> }).counts);
      await page.click("#play-sound");
      await expect.poll(async () => (await counts())["starts"]).toBe(2);
      for (const heard of ["b", "a", "b"]) await page.check(`#listen input[value="${heard}"]`);
      expect(await counts()).toEqual({ starts: 2, stops: 0, jumps: 0, fades: 6 });
      expect(await page.textContent("#play-sound")).toBe("Pause");
      await page.click("#play-sound");
      expect(await page.textContent("#play-sound")).toBe("Play");
      expect(problems).toEqual([]);
    },
    PATIENCE_MS,
  );

  it(
    "fits a phone and shows pictures without graphics",
    async () => {
      const plain = await launchWithoutGraphics();
      try {
        const phone = await plain.newPage({ viewport: { width: 390, height: 844 } });
        await phone.goto(address);
        await phone.waitForFunction(() => document.querySelector("#view-a .readout")!.textContent !== "");
        expect(await phone.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
        for (const side of ["a", "b"]) expect(await phone.isVisible(`#view-${side} img`)).toBe(true);
      } finally {
        await plain.close();
      }
    },
    PATIENCE_MS,
  );
});

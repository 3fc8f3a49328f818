// SPDX-License-Identifier: MIT
// Two runs side by side, from the page: how they are joined, how far their parts are apart, and the window that shows it.
import { readFileSync } from "node:fs";
import type { Frame, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { ChunkFrame, Cutter, Row } from "@tribo/protocol/frames";
import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { jobText } from "../../testing/job.js";
import { hasMillPage, MillPage } from "../../testing/mill_page.js";
import { join, largest, QUANTITIES } from "../src/compare/join.js";
import { extremesOf, packed, rangeOf, REACH_MM, surfaceOf } from "../src/compare/surface.js";

const CUTTERS: Cutter[] = [{ number: 1, flutes: 2, radius: 3, corner: 0, length: 10, holder: [] }];

function row(line: number, time: number, duration: number, peakForce: number): Row {
  return {
    time,
    duration,
    tip: [time, 0, 0],
    meanForce: peakForce / 2,
    peakForce,
    torque: -peakForce / 1000,
    entry: 0,
    exit: 90,
    depth: 1,
    feedPerTooth: 0.1,
    line,
    chip: 0.05,
    chipVerdict: "",
    multiplier: 0,
    rpm: 1000,
    axis: [0, 0, 1],
    cutter: 0,
    peakLow: 0,
    peakHigh: 0,
  };
}
const cuts = (...rows: Row[]) => ({ rows, cutters: CUTTERS });
const value = (name: string) => QUANTITIES.findIndex((quantity) => quantity.name === name);

describe("two cuts are joined", () => {
  const a = cuts(row(3, 1, 1, 100), row(3, 2, 3, 300), row(5, 6, 2, 50));
  it("by line where both cut in the same lines, each as long as it takes", () => {
    const joined = join(a, cuts(row(3, 1, 2, 400), row(5, 4, 1, 20)));
    expect([joined.by, joined.pairs.length]).toEqual(["line", 2]);
    const [first] = joined.pairs;
    expect([first!.at, first!.width, first!.b!.to_s]).toEqual([1, 4, 3]);
    expect(first!.a!.tip).toEqual([2, 0, 0]);
    expect(first!.a!.values[value("peak force across the axis")]).toBe(300);
    // (50 * 1 + 150 * 3) / 4
    expect(first!.a!.values[value("mean force")]).toBe(125);
    expect(first!.a!.values[value("peak torque")]).toBe(0.3);
    // 0.1 mm, two teeth, 1000 turns
    expect(first!.a!.values[value("feed")]).toBeCloseTo(200, 12);
    expect(largest(joined, 1).map(({ a: of, b }) => [of.line, b.values[0]! - of.values[0]!])).toEqual([[3, 100]]);
  });
  it("by time else, and every second of a row is in a step", () => {
    const joined = join(a, cuts(row(7, 0, 10, 40)));
    expect([joined.by, joined.step_s]).toEqual(["time", 0.01]);
    const sum = (side: "a" | "b") =>
      joined.pairs.reduce((all, pair) => all + (pair[side]?.values[value("cutting time")] ?? 0), 0);
    expect(sum("a")).toBeCloseTo(6, 9);
    expect(sum("b")).toBeCloseTo(10, 9);
    // Between 5 and 6 s A cuts nothing.
    const at = (time: number) => joined.pairs.find((pair) => pair.at <= time && time < pair.at + pair.width)!;
    expect([at(5.505).a, at(5.505).b!.values[0]]).toEqual([undefined, 40]);
  });
  it("if one of them cuts nothing", () => {
    expect(join(cuts(), cuts()).pairs).toEqual([]);
    expect(join(a, cuts()).pairs.every(({ b }) => b === undefined)).toBe(true);
  });
});

/** A strip of squares along x from `from`, with a distance for each of its places. */
function strip(from: number, distances: number[]): ChunkFrame {
  const positions = distances.flatMap((_, n) => [from + n, 0, 0, from + n, 1, 0]);
  const indices = distances.slice(1).flatMap((_, n) => [2 * n, 2 * n + 2, 2 * n + 1, 2 * n + 1, 2 * n + 2, 2 * n + 3]);
  return {
    kind: "chunk",
    chunk: [from, 0, 0],
    positions: Float32Array.from(positions),
    indices: Uint16Array.from(indices),
    deviations: Float32Array.from(distances.flatMap((mm) => [mm, mm])),
    onBlank: 0,
    rough: false,
  };
}

describe("the difference of two parts", () => {
  it("is one surface of all pieces, and beyond its reach has the sign of what is near", () => {
    const unknown = Number.NaN;
    const surface = surfaceOf([strip(0, [0.00001, 1, 2.5, unknown, unknown]), strip(4, [unknown, 2, 1, -0.5])], 1);
    // 5 + 4 places along x, of which one is in both.
    expect(surface.untouched.length).toBe(16);
    const near = (x: number) =>
      surface.differences[[...surface.positions].findIndex((v, n) => n % 3 === 0 && v === x) / 3];
    expect([0, 2, 3, 4, 7].map(near)).toEqual([0, 2.5, REACH_MM, REACH_MM, -0.5]);
    expect(extremesOf([surface])).toEqual({ more: { mm: 3, at: [3, 0, 0] }, less: { mm: -0.5, at: [7, 0, 0] } });
    expect(surfaceOf([strip(0, [0, 1])], -1).differences[2]).toBe(-1);
  });
  it("is nothing between equal parts", () => {
    const same = surfaceOf([strip(0, [0, 5e-5, -5e-5])], 1);
    expect(extremesOf([same])).toEqual({ more: undefined, less: undefined });
    expect(rangeOf([same])).toBe(1e-3);
  });
  it("is packed as the views take it", () => {
    const surface = surfaceOf([strip(0, [0, 0.25, 0.5])], 1);
    const { part, bytes } = packed(surface, 0.5);
    expect([part.vertices, part.triangles, part.origin]).toEqual([6, 4, [0, 0, 0]]);
    expect(bytes.length).toBe(6 * (6 + 2 + 1) + 4 * 6);
    const view = new DataView(bytes.buffer);
    // The last place: x = 2, y = 1, and its distance.
    expect(view.getUint16(30, true) * part.step).toBeCloseTo(2, 3);
    expect(view.getUint16(32, true) * part.step).toBeCloseTo(1, 3);
    expect(view.getInt16(36 + 2 * 5, true) * part.deviation_step).toBeCloseTo(0.5, 3);
  });
});

const JOB = jobText("[[0, 0, -8], [30, 20, 0]]");
const PROGRAM = "G21 G90 F1200\nG0 X-5 Y6 Z5\nG1 Z-2\nG1 X35\nG0 Z5\nG0 Y14 X-5\nG1 Z-2\nG1 X35\n";

describe.runIf(hasMillPage)("two runs from the page", () => {
  let mill: MillPage;
  let page: Page;
  let frame: Frame;

  beforeAll(async () => {
    mill = await MillPage.open();
    ({ page } = mill);
    await mill.load(file("job.toml", JOB), file("p.nc", PROGRAM));
    await page.click("#show-panel");
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  const compare = async () => {
    await page.click("#compare-runs");
    await page.waitForSelector("#comparison iframe", { timeout: 2 * PATIENCE_MS });
    frame = (await (await page.waitForSelector("#comparison iframe")).contentFrame())!;
    await frame.waitForFunction(() => document.querySelectorAll(".live:not([hidden])").length === 2);
  };
  const read = (side: string) => frame.textContent(`#view-${side} .readout`);

  it("keeps the first one as A", async () => {
    expect(await page.isVisible("#compare-runs")).toBe(false);
    await page.click("#keep-a");
    await mill.until("A is job.toml", "compare-said");
    expect(await violations(page)).toEqual([]);
  });

  it(
    "finds no difference between a run and itself",
    async () => {
      await compare();
      expect(await frame.textContent(".verdict")).toBe(
        "Time, peak force and peak power do not differ. The parts are the same.",
      );
      expect(await frame.textContent("#parts .facts")).toBe(
        "Both parts hold the same material.Their surfaces are the same.",
      );
      await page.click("#comparison-close");
    },
    3 * PATIENCE_MS,
  );

  it(
    "compares it with another cutter: where it cuts deeper, and with which force",
    async () => {
      // A ball of 8 mm in place of 6 mm: at the side of the slot it reaches out by a millimetre at the most.
      await page.evaluate(() => {
        const text = document.querySelector<HTMLTextAreaElement>("#job-text")!;
        text.value = text.value.replace("diameter_mm = 6", "diameter_mm = 8");
        text.dispatchEvent(new Event("change"));
      });
      await page.click("#mill-again");
      await page.waitForFunction(() => document.querySelector<HTMLButtonElement>("#setup-back")?.disabled === false);
      await compare();
      expect(await frame.textContent(".verdict")).toMatch(/^B: peak force across the axis .* The parts are up to \d/);
      expect(await frame.textContent(".facts")).toContain("The cutters differ.");
      const facts = (await frame.textContent("#parts .facts"))!;
      const [, onlyA] = /^Only A holds ([\d.]+) mm³, only B holds 0 mm³\.B cuts [\d.]+ mm deeper at most, at /.exec(
        facts,
      )!;
      // Two slots of 30 mm, 2 mm deep: segments of a circle.
      const slot = (r: number) => r ** 2 * Math.acos((r - 2) / r) - (r - 2) * Math.sqrt(4 * r - 4);
      expect(Number(onlyA) / (60 * (slot(4) - slot(3)))).toBeCloseTo(1, 2);
      // The edge of the slot of A, 2 mm below the centre of the ball of B and sqrt(3^2 - 1^2) mm beside it.
      expect(Number(/cuts ([\d.]+) mm/.exec(facts)![1])).toBeCloseTo(4 - Math.sqrt(12), 3);
      expect(facts).not.toContain("leaves");
    },
    3 * PATIENCE_MS,
  );

  it("moves both runs to the same line, under one camera", async () => {
    await frame.fill("#place", "0");
    const line = /line (\d+)/.exec((await read("a"))!)![1];
    expect(await read("b")).toContain(`line ${line} `);
    const picture = (side: string) =>
      frame.evaluate((id) => document.querySelector<HTMLCanvasElement>(`#view-${id} canvas`)!.toDataURL(), side);
    const before = [await picture("a"), await picture("b")];
    await frame.focus("#view-a canvas");
    await page.keyboard.press("ArrowLeft");
    await expect.poll(() => picture("b")).not.toBe(before[1]);
    expect(await picture("a")).not.toBe(before[0]);
  });

  it("plays both sounds at once, and is accessible", async () => {
    await frame.click("#play-sound");
    await expect.poll(() => frame.textContent("#play-sound")).toBe("Pause");
    await frame.check('#listen input[value="b"]');
    await frame.click("#play-sound");
    // Of both documents: axe looks into frames.
    expect(await violations(page)).toEqual([]);
    await mill.picture("comparison");
  });

  it("is saved as one file, that opens without the page", async () => {
    const waiting = page.waitForEvent("download");
    await page.click("#comparison-save");
    const saved = readFileSync(await (await waiting).path(), "utf8");
    expect(saved).toContain("Content-Security-Policy");
    const offline = await mill.browser.newPage();
    const problems: string[] = [];
    offline.on("pageerror", ({ message }) => problems.push(message));
    await offline.setContent(saved);
    await offline.waitForFunction(() => document.querySelectorAll(".live:not([hidden])").length === 2);
    expect(problems).toEqual([]);
    await offline.close();
  });

  it("fits a phone", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await page.waitForTimeout(300);
    expect(await frame.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    await mill.picture("comparison-phone");
    await page.click("#comparison-close");
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    await page.locator("#compare").scrollIntoViewIfNeeded();
    await mill.picture("compare-phone");
    await page.setViewportSize({ width: 1000, height: 700 });
  });

  it("makes no error", () => expect(mill.problems).toEqual([]));
});

// SPDX-License-Identifier: MIT
// Two runs side by side, from the page: how they are joined, how far their parts are apart, and the window that shows it.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Frame, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { ChunkFrame } from "@tribo/protocol/frames";
import type { MillExports } from "@tribo/wasm/exports";
import { joinedOf, type Joined } from "@tribo/wasm/joined";
import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { jobText } from "../../testing/job.js";
import { hasMillPage, MillPage } from "../../testing/mill_page.js";
import { PROGRAM as ENGINE } from "../../tools/places.js";
import { load } from "../../wasm/test/load.js";
import { largest } from "../src/compare/page.js";
import { runOf, type Side } from "../src/compare/run.js";
import { extremesOf, packed, rangeOf, REACH_MM, surfaceOf } from "../src/compare/surface.js";

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

const CELL_MM = 0.25;
const SLOTS = "G21 G90 F1200\nG0 X-5 Y6 Z5\nG1 Z-2\nG1 X35\nG0 Z5\nG0 Y14 X-5\nG1 Z-2\nG1 X35\n";

describe.runIf(existsSync(ENGINE))("two cuts are joined as tribo compare joins them", () => {
  const folder = mkdtempSync(join(tmpdir(), "tribo-joined-"));
  afterAll(() => rmSync(folder, { recursive: true }));

  const joinedInPage = async (a: string, b: string): Promise<Joined> => {
    const mill = await load<MillExports>("tribo");
    const side = (program: string): Side => {
      const bytes = (text: string) => new TextEncoder().encode(text);
      return {
        files: [
          { name: "job.toml", bytes: bytes(JOB) },
          { name: "p.nc", bytes: bytes(program) },
        ],
        job: "job.toml",
        part: "",
        changes: [],
      };
    };
    runOf(mill, side(a), CELL_MM, () => {});
    mill.mill_keep();
    mill.mill_forget_files();
    runOf(mill, side(b), CELL_MM, () => {});
    return joinedOf(mill);
  };
  // Of compare.csv: the tips, as the page has other pieces and of equal peaks the first one counts, and differences.
  const isLeftOut = (name: string) => name.includes("_tip_") || name.startsWith("difference");
  // Rows of numbers; an empty cell is NaN.
  const joinedByEngine = (a: string, b: string): number[][] => {
    for (const [name, program] of Object.entries({ a, b })) {
      writeFileSync(join(folder, `${name}.toml`), JOB.replace("p.nc", `${name}.nc`) + '[sound]\nmode = "pan"\n');
      writeFileSync(join(folder, `${name}.nc`), program);
    }
    const jobs = ["a.toml", "b.toml"].map((name) => join(folder, name));
    const out = join(folder, "out");
    execFileSync(ENGINE, ["compare", ...jobs, "--out", out, "--resolution", String(CELL_MM)], { stdio: "pipe" });
    const [head, ...rows] = readFileSync(join(out, "compare.csv"), "utf8").trimEnd().split("\n");
    const names = head!.split(",");
    return rows.map((row) => {
      const numbers = row.split(",").map((cell) => (cell === "" ? Number.NaN : Number(cell)));
      return numbers.filter((_, column) => !isLeftOut(names[column]!));
    });
  };
  // As the rows of the engine.
  const rowsOf = ({ pairs, quantities }: Joined): number[][] =>
    pairs.map(({ place, a, b }) => {
      const placed = [a, b].flatMap((side) => (side ? [side.from_s, side.line] : [NaN, NaN]));
      const values = quantities.flatMap((_, n) => [a?.values[n] ?? NaN, b?.values[n] ?? NaN]);
      return [place, ...placed, ...values];
    });

  it.each([
    ["line", SLOTS.replace("F1200", "F600")],
    // The other slot first, from the other side.
    ["removed volume", "G21 G90 F1200\nG0 X35 Y14 Z5\n\nG1 Z-2\n\nG1 X-5\nG0 Z5\nG0 Y6\nG1 Z-2\nG1 X35\n"],
    ["time", "G21 G90 F1200\nG0 X-5 Y6 Z5\n\nG1 Z-1\nG1 X35\n"],
  ])("by %s", async (by, program) => {
    const joined = await joinedInPage(SLOTS, program);
    expect(joined.by).toBe(by);
    const [here, there] = [rowsOf(joined), joinedByEngine(SLOTS, program)];
    expect(here.length).toBe(there.length);
    expect(here.length).toBeGreaterThan(by === "line" ? 1 : 100);
    // The page cuts long moves into shorter pieces, whose rows share the removed volume in another way.
    const same = (value: number, expected: number) =>
      Object.is(value, expected) || Math.abs(value - expected) < 1e-2 * (0.01 + Math.abs(expected));
    const others = here.flatMap((row, n) => {
      const column = there[n]!.findIndex((expected, k) => !same(row[k]!, expected));
      return column < 0 && row.length === there[n]!.length ? [] : [[n, column, row[column], there[n]![column]]];
    });
    // A step of the volume that ends where a row ends may have the row in one of them only.
    expect(others.length, JSON.stringify(others)).toBeLessThanOrEqual(here.length / 100);
    const changes = joined.pairs.map(({ a, b }) => Math.abs((b?.values[0] ?? NaN) - (a?.values[0] ?? NaN)));
    const sorted = changes.filter((change) => change > 0).sort((one, other) => other - one);
    const found = largest(joined, 3).map(({ a, b }) => Math.abs(b.values[0]! - a.values[0]!));
    expect(found).toEqual(sorted.slice(0, 3));
  });
});

describe.runIf(hasMillPage)("two runs from the page", () => {
  let mill: MillPage;
  let page: Page;
  let frame: Frame;

  beforeAll(async () => {
    mill = await MillPage.open();
    ({ page } = mill);
    await mill.load(file("job.toml", JOB), file("p.nc", SLOTS));
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

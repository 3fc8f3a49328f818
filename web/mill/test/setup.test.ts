// SPDX-License-Identifier: MIT
// Values in the text of a job are read and changed where they stand, and nothing else is.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { entriesOf, quoted, unquoted, withKey, withoutLine, withValue } from "../src/setup/job_text.js";
import { boxOf, FACES, middleOf, moved, nearestOnAxis, stepFor, textOf, type Box } from "../src/setup/stock_box.js";
import { Undo } from "../src/setup/undo.js";
import { chainOf, clampingOf, textOf as textOfFile, withClamping, withZero, zeroOf } from "../src/setup/chain.js";
import { withJob } from "../src/setup/with_job.js";
import type { Vec3 } from "@tribo/protocol/vec3";
import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, JOB as SLOT, MillPage, PROGRAM } from "../../testing/mill_page.js";
import { ROOT } from "../../tools/places.js";

const JOB = `# A job
[stock]   # of it
box_mm = [[0, 0, -6], [30, 16, 0]]  # mm
[[cutter]]
number = 1
diameter_mm = 6.35# "half" [an] inch
pitch_deg = [
  80, # first
  100,
]
flutes=2
[[cutter]]
diameter_mm = 3

[material]
name = "a # no comment \\" in it"   # but this is
[path]
gcode = 'p[1].nc'
`;

describe("an order with another job", () => {
  const from = (job: string) => ({ files: [{ name: job, bytes: new ArrayBuffer(3) }], job, part: "", cell: 0 });
  it("keeps the program beside the job that stands for it, and a job in its place", () => {
    const program = withJob(from("folder/p 1.nc"), "x = 1");
    expect(program.job).toBe("p 1.toml");
    expect(program.files.map(({ name }) => name)).toEqual(["folder/p 1.nc", "p 1.toml"]);
    expect(new TextDecoder().decode(program.files[1]!.bytes)).toBe("x = 1");
    const job = withJob(withJob(from("a/job.TOML"), "y = 2"), "z = 3");
    expect(job.files.map(({ name, bytes }) => [name, bytes.byteLength])).toEqual([["a/job.TOML", 5]]);
  });
});

describe("a chain of set-ups", () => {
  const jobFile = (name: string, text: string) => ({ name, bytes: new TextEncoder().encode(text).buffer });
  const top = jobFile("a/top.toml", "[stock]\nbox_mm = [[0, 0, 0], [1, 1, 1]]\n");
  const side = jobFile("a/side.toml", "[stock]\nfrom = 'top.toml' # first\n");
  const bottom = jobFile("a/bottom.toml", '[stock]\nfrom = "side.toml"\n');
  const of = (...files: { name: string; bytes: ArrayBuffer }[]) => ({ files, job: "a/bottom.toml", part: "", cell: 0 });

  it("begins with the job that has a stock of its own", () => {
    expect(chainOf(of(bottom, top, side)).map(({ name }) => name)).toEqual([
      "a/top.toml",
      "a/side.toml",
      "a/bottom.toml",
    ]);
    expect(chainOf({ files: [top], job: "p.nc" })).toEqual([]);
    // One that begins with itself ends somewhere.
    const round = jobFile("a/bottom.toml", '[stock]\nfrom = "bottom.toml"\n');
    expect(chainOf(of(round)).length).toBe(1);
  });
  it("has an earlier job changed, and stays the order of the last one", () => {
    const order = withJob(of(bottom, top, side), "x = 1", "a/top.toml");
    expect(order.job).toBe("a/bottom.toml");
    expect(textOfFile(order.files.find(({ name }) => name === "a/top.toml")!)).toBe("x = 1");
    expect(order.files.length).toBe(3);
  });
  it("is clamped as it is chosen, and back", () => {
    const text = '[stock]\nfrom = "top.toml"\n[path]\ngcode = "b.nc"\n';
    expect(clampingOf(text)).toBe("same");
    for (const clamping of ["over x", "over y", "same"] as const)
      expect(clampingOf(withClamping(text, clamping))).toBe(clamping);
    expect(clampingOf(withClamping(withClamping(text, "over y"), "over x"))).toBe("over x");
    const own = `${text}[setup]\nx_axis = [1, 1, 0]\n`;
    expect([clampingOf(own), withClamping(own, "other")]).toEqual(["other", own]);
    // Any length.
    expect(clampingOf(`${text}[setup]\nz_axis = [0, 0, -2.5] # down\n`)).toBe("over x");
    expect([zeroOf(text), zeroOf(withZero(text, [0, 40, -20]))]).toEqual([
      [0, 0, 0],
      [0, 40, -20],
    ]);
    expect(zeroOf(`${text}[setup]\norigin_mm = 3\n`)).toBeUndefined();
  });
});

describe("the text of a job", () => {
  it("has the values that stand in one line, with their tables", () => {
    expect(entriesOf(JOB).map(({ table, nth, key, raw }) => [table, nth, key, raw])).toEqual([
      ["stock", 0, "box_mm", "[[0, 0, -6], [30, 16, 0]]"],
      ["cutter", 0, "number", "1"],
      ["cutter", 0, "diameter_mm", "6.35"],
      ["cutter", 0, "flutes", "2"],
      ["cutter", 1, "diameter_mm", "3"],
      ["material", 0, "name", '"a # no comment \\" in it"'],
      ["path", 0, "gcode", "'p[1].nc'"],
    ]);
    expect(entriesOf(JOB.replaceAll("\n", "\r\n")).map(({ raw }) => raw)).toEqual(entriesOf(JOB).map(({ raw }) => raw));
  });
  it("changes a value alone: each one for itself, and back", () => {
    for (const entry of entriesOf(JOB)) {
      const other = withValue(JOB, entry.line, "42");
      expect(entriesOf(other).map(({ raw }) => raw)).toEqual(
        entriesOf(JOB).map(({ raw, line }) => (line === entry.line ? "42" : raw)),
      );
      expect(withValue(other, entry.line, entry.raw)).toBe(JOB);
    }
  });
  it("takes a key that it has not yet, in its table or a new one", () => {
    const milled = withKey(JOB, "path", "machine", quoted("xyzac-trt"));
    expect(milled).toBe(JOB.replace("[path]\n", '[path]\nmachine = "xyzac-trt"\n'));
    expect(withKey(milled, "path", "machine", quoted("head-head"))).toBe(milled.replace("xyzac-trt", "head-head"));
    const { line } = entriesOf(milled).find(({ key }) => key === "machine")!;
    expect(withoutLine(milled, line)).toBe(JOB);
    expect(entriesOf(withKey(JOB, "process", "spindle_rpm", "9000")).at(-1)).toMatchObject({
      table: "process",
      raw: "9000",
    });
  });
  it("has strings in both kinds of quotes", () => {
    expect(["'a\"b'", '"a\\u00e9\\n"', "3", "[1]"].map(unquoted)).toEqual(['a"b', "a\u00e9\n", undefined, undefined]);
  });
});

// Numbers between -1 and 1 that are the same in each run (a linear congruential generator, Knuth 1997, 3.3.4).
function* numbers(): Generator<number> {
  for (let state = 1; ; state = (Math.imul(state, 1664525) + 1013904223) >>> 0) yield state / 2 ** 31 - 1;
}

describe("the box of the stock", () => {
  const BOX: Box = [
    [0, 0, -6],
    [30, 16, 0],
  ];
  it("is read from its text and written as it was", () => {
    expect(boxOf("[[0, 0, -6], [30, 16, 0]]")).toEqual(BOX);
    expect(boxOf("[ [0,0.0,-6.0],[3_0 ,1.6e1,0] ]")).toEqual(BOX);
    expect(boxOf(textOf(BOX))).toEqual(BOX);
    for (const text of ["[[0, 0], [1, 1]]", "[[0, 0, 0], [1, 1, a]]", "[[0, 0, ], [1, 1, 1]]", "1", ""])
      expect(boxOf(text)).toBeUndefined();
  });
  it("has a face moved, and nothing else, and stays a box", () => {
    for (const face of FACES) {
      const to = middleOf(BOX, face)[face.axis] + (face.end === 0 ? -3 : 3);
      const other = moved(BOX, face, to, 1);
      for (const end of [0, 1] as const)
        for (const axis of [0, 1, 2] as const)
          expect(other[end][axis]).toBe(end === face.end && axis === face.axis ? to : BOX[end][axis]);
      const thin = moved(BOX, face, face.end === 0 ? 1000 : -1000, 0.5);
      expect(thin[1][face.axis] - thin[0][face.axis]).toBeCloseTo(0.5, 12);
    }
  });
  it("moves by a power of ten, a hundredth to a thousandth of its size", () => {
    for (let size = 1e-2; size < 1e5; size *= 1.7) {
      expect(size / stepFor(size)).toBeGreaterThanOrEqual(100 * (1 - 1e-9));
      expect(size / stepFor(size)).toBeLessThan(1000 * (1 + 1e-9));
      expect(Math.log10(stepFor(size)) % 1).toBeCloseTo(0, 12);
    }
  });
  it("follows the pointer: no place of the axis is nearer to the ray", () => {
    const next = numbers();
    const some = () => next.next().value as number;
    for (let n = 0; n < 500; ++n) {
      const origin: Vec3 = [100 * some(), 100 * some(), 100 * some()];
      const point: Vec3 = [50 * some(), 50 * some(), 50 * some()];
      const towards: Vec3 = [some(), some(), some()];
      const size = Math.hypot(...towards);
      const direction: Vec3 = [towards[0] / size, towards[1] / size, towards[2] / size];
      const axis = (n % 3) as 0 | 1 | 2;
      const at = nearestOnAxis(origin, direction, point, axis);
      // Along the axis no place is the nearest.
      expect(at === undefined).toBe(1 - direction[axis] ** 2 < 1e-3);
      if (at === undefined) continue;
      // The distance of a point to the line of the ray, by the cross product.
      const away = (coordinate: number) => {
        const d = point.map((v, k) => (k === axis ? coordinate : v) - origin[k]!) as unknown as Vec3;
        return Math.hypot(
          d[1] * direction[2] - d[2] * direction[1],
          d[2] * direction[0] - d[0] * direction[2],
          d[0] * direction[1] - d[1] * direction[0],
        );
      };
      for (const off of [-1, -0.01, 0.01, 1]) expect(away(at)).toBeLessThan(away(at + off));
    }
  });
});

describe("undo", () => {
  it("goes back and forward, and forgets what was undone when something new comes", () => {
    const undo = new Undo("a");
    expect([undo.canUndo, undo.canRedo, undo.undo(), undo.redo()]).toEqual([false, false, "a", "a"]);
    for (const state of ["b", "b", "c"]) undo.commit(state);
    expect([undo.undo(), undo.undo(), undo.undo(), undo.redo()]).toEqual(["b", "a", "a", "b"]);
    undo.commit("d");
    expect([undo.canRedo, undo.undo(), undo.undo(), undo.redo(), undo.redo()]).toEqual([false, "b", "a", "b", "d"]);
  });
});

describe.runIf(hasMillPage)("the stock in the picture", () => {
  let mill: MillPage;
  beforeAll(async () => {
    mill = await MillPage.open();
    await mill.page.setViewportSize({ width: 1280, height: 800 });
    await mill.load(file("job.toml", SLOT), file("p.nc", PROGRAM));
    await mill.page.click("#show-panel");
    await mill.page.waitForSelector("#setup-card:not([hidden])", { timeout: PATIENCE_MS });
    await mill.page.waitForTimeout(500);
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  const text = () => mill.page.inputValue("#job-text");
  const box = async () => boxOf(/box_mm = (.*)/.exec(await text())![1]!)!;
  // Handles are blue in a grey picture; their middles are found in it, from the top.
  const handles = () =>
    mill.page.evaluate(async () => {
      const canvas = document.getElementById("scene") as HTMLCanvasElement;
      await new Promise((drawn) => requestAnimationFrame(drawn));
      const seen = new Image();
      seen.src = (window as unknown as { shot: string }).shot;
      await seen.decode();
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.clientWidth, canvas.clientHeight];
      const c = copy.getContext("2d")!;
      c.drawImage(seen, 0, 0);
      const { data } = c.getImageData(0, 0, copy.width, copy.height);
      const places: { x: number; y: number; n: number }[] = [];
      for (let y = 60; y < copy.height - 170; ++y)
        for (let x = 260; x < copy.width - 290; ++x) {
          const at = 4 * (y * copy.width + x);
          if (data[at + 2]! - data[at]! < 110) continue;
          const near = places.find((p) => Math.hypot(p.x / p.n - x, p.y / p.n - y) < 14);
          if (near) [near.x, near.y, near.n] = [near.x + x, near.y + y, near.n + 1];
          else places.push({ x, y, n: 1 });
        }
      return places.filter(({ n }) => n > 60).map(({ x, y, n }) => ({ x: x / n, y: y / n }));
    });
  const look = async () => {
    const shot = `data:image/png;base64,${(await mill.page.screenshot()).toString("base64")}`;
    await mill.page.evaluate((url) => ((window as unknown as { shot: string }).shot = url), shot);
    return handles();
  };

  it(
    "has a handle on each face; one that is dragged changes its number alone, and undo brings it back",
    async () => {
      const { page } = mill;
      await mill.picture("stock-handles");
      await expect.poll(async () => (await look()).length, { timeout: PATIENCE_MS }).toBe(6);
      const places = await look();
      const before = await box();
      expect(before).toEqual([
        [0, 0, -6],
        [30, 16, 0],
      ]);
      const [top] = places.sort((a, b) => a.y - b.y);
      await page.mouse.move(top!.x, top!.y);
      await page.mouse.down();
      await page.mouse.move(top!.x, top!.y - 25, { steps: 4 });
      await page.mouse.move(top!.x, top!.y - 50, { steps: 4 });
      // The finger does not press.
      expect(await page.getAttribute("#scene", "class")).not.toContain("touching");
      await page.mouse.up();
      const after = await box();
      const changed = [0, 1].flatMap((end) => [0, 1, 2].filter((k) => after[end]![k] !== before[end]![k]));
      expect(changed.length).toBe(1);
      await mill.picture("stock-dragged");
      await page.focus("#scene");
      await page.keyboard.press("Control+z");
      expect(await box()).toEqual(before);
      await page.keyboard.press("Control+Shift+z");
      expect(await box()).toEqual(after);
      await page.click("#setup-undo");
      expect(await box()).toEqual(before);
      expect(await page.isDisabled("#setup-undo")).toBe(true);
      await page.click("#setup-redo");
      await page.click("#mill-again");
      await page.waitForSelector("#setup-back:not([disabled])", { timeout: PATIENCE_MS });
      expect(await box()).toEqual(after);
      // Without the card there are no handles.
      await page.click("#show-panel");
      expect(await look()).toEqual([]);
    },
    PATIENCE_MS,
  );

  it("makes no error", () => expect(mill.problems).toEqual([]));
});

describe.runIf(hasMillPage)("two set-ups on the card", () => {
  let mill: MillPage;
  beforeAll(async () => {
    mill = await MillPage.open();
    const parts = ["bottom.toml", "bottom.nc", "top.toml", "top.nc"];
    const files = parts.map((name) => file(name, readFileSync(join(ROOT, "examples/housing", name), "utf8")));
    await mill.load(...files);
    await mill.until("bottom.toml", "job");
    await mill.page.click("#show-panel");
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  const field = (label: string) => mill.page.locator("#setup-form label", { hasText: label }).locator("input, select");

  it(
    "are turned to, changed and milled again, the second one on what the first one leaves",
    async () => {
      const { page } = mill;
      await expect.poll(() => field("set-up").inputValue()).toBe("bottom.toml");
      expect(await field("clamped").inputValue()).toBe("over x");
      expect([await field("zero y").inputValue(), await field("zero z").inputValue()]).toEqual(["40", "-20"]);
      expect(await violations(page)).toEqual([]);
      await mill.picture("two-set-ups");
      await field("set-up").selectOption("top.toml");
      await expect.poll(() => page.inputValue("#job-text")).toContain("box_mm = [[0, 0, -20]");
      const diameter = field("diameter").first();
      await diameter.fill("9");
      await diameter.blur();
      await page.click("#mill-again");
      await page.waitForSelector("#setup-back:not([disabled])", { timeout: PATIENCE_MS });
      // The first one stays at hand, and the second one is milled.
      expect(await field("set-up").inputValue()).toBe("top.toml");
      expect(await mill.text("job")).toBe("bottom.toml");
      expect(await page.inputValue("#job-text")).toContain("diameter_mm = 9");
      await field("set-up").selectOption("bottom.toml");
      await field("clamped").selectOption("over y");
      expect(await page.inputValue("#job-text")).toContain("x_axis = [-1, 0, 0]");
      await page.click("#setup-undo");
      expect(await field("clamped").inputValue()).toBe("over x");
    },
    2 * PATIENCE_MS,
  );

  it("makes no error", () => expect(mill.problems).toEqual([]));
});

// SPDX-License-Identifier: MIT
// The panels of the bench, without a browser: lanes, program, numbers, verdict, histogram.
import { describe, expect, it, vi } from "vitest";

import type { Piece, Row } from "@tribo/protocol/frames";
import { AUDIT_COLUMNS } from "@tribo/wasm/audit";
import { Bins, roundUp, timeMarks } from "../src/lanes/bins.js";
import { level } from "../src/lanes/level.js";

// The modules of panels look for their elements when they are made, not when they are read.
vi.stubGlobal("document", {});
const { bandWords, powerOf, sharesOf } = await import("../src/panels/now.js");
const { LineLoads, lineTimes } = await import("../src/panels/program.js");
const { judge } = await import("../src/panels/verdict.js");
const { fullScaleOf, spreadOf } = await import("../src/panels/colours.js");

describe("a lane", () => {
  it("shows the largest value of each column, and nothing where there is none", () => {
    const bins = new Bins();
    bins.begin(100);
    bins.add(0, 15, 5);
    bins.add(50, 25, 7);
    bins.add(60, 5, 9);
    const columns = bins.columns(10);
    expect([...columns]).toEqual([5, 5, Number.NaN, Number.NaN, Number.NaN, 7, 9, 7, Number.NaN, Number.NaN]);
    expect(bins.largest).toBe(9);
    expect(bins.at(62)).toBe(9);
    expect(bins.at(30)).toBeNaN();
  });
  // However narrow: a peak of a millisecond is seen in a lane of a few pixels.
  it("loses no peak at any width", () => {
    for (const width of [3, 100, 1437, 5000]) {
      const bins = new Bins();
      bins.begin(3600);
      bins.add(1234.5, 0.001, 42);
      expect(Math.max(...[...bins.columns(width)].filter((v) => !Number.isNaN(v)))).toBe(42);
    }
  });
  it("takes no value that is none, and none out of its time", () => {
    const bins = new Bins();
    bins.begin(0);
    bins.begin(10);
    for (const value of [0, -1, Number.NaN]) bins.add(1, 1, value);
    bins.add(-5, 1, 3);
    bins.add(50, 1, 3);
    expect([...bins.columns(7)].every(Number.isNaN)).toBe(true);
    expect(bins.at(5)).toBeNaN();
  });
  it("ends at a round number that is not smaller", () => {
    for (let value = 1e-4; value < 1e6; value *= 1.13) {
      expect(roundUp(value)).toBeGreaterThanOrEqual(value * (1 - 1e-9));
      expect(roundUp(value)).toBeLessThan(1.5 * value);
    }
    expect(roundUp(0)).toBe(1);
  });
  it("marks times at even steps", () => {
    expect(timeMarks(176, 12)).toEqual([0, 15, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165]);
    expect(timeMarks(0.5, 10)).toEqual([0]);
    for (const duration of [1, 77, 4000, 1e6]) expect(timeMarks(duration, 10).length).toBeLessThan(13);
  });
});

describe("the level of a piece", () => {
  const piece = (...harmonics: number[]) => ({ harmonics: new Float32Array(harmonics) }) as Piece;
  it("is that of the force that changes, across the axis", () => {
    // 2 |h| = 1 N peak is 0.707 N effective: 20 lg 7.07.
    expect(level(piece(9, 0, 9, 0, 9, 0, 0.5, 0, 0, 0, 7, 7))).toBeCloseTo(20 * Math.log10(Math.SQRT1_2 / 0.1), 5);
    expect(level(piece(9, 0, 9, 0, 9, 0))).toBe(0);
  });
});

describe("the program", () => {
  it("knows when each line first runs", () => {
    const times = new Float32Array([0, 1, 2, 4, 8]);
    const lines = new Uint32Array([3, 3, 5, 3, 7]);
    expect([...lineTimes({ times, lines })]).toEqual([
      [3, 0],
      [5, 1],
      [7, 4],
    ]);
  });
  it("has the load of each line as a share of the largest", () => {
    const loads = new LineLoads();
    expect(loads.of(1)).toBe(0);
    loads.add([
      { line: 1, peakForce: 10 },
      { line: 1, peakForce: 5 },
      { line: 2, peakForce: 40 },
    ] as Row[]);
    expect([loads.of(1), loads.of(2), loads.of(3), loads.force(1)]).toEqual([0.25, 1, 0, 10]);
    loads.clear();
    expect(loads.of(2)).toBe(0);
  });
});

describe("the numbers", () => {
  it("have no more digits than their band", () => {
    expect(bandWords(532.4, 1168.9)).toBe("530 to 1170");
    expect(bandWords(5.2, 9.9)).toBe("5 to 10");
    expect(bandWords(12_345, 34_567)).toBe("12000 to 35000");
  });
  it("have the power of torque and speed", () => {
    expect(powerOf({ torque: 10, rpm: 6000 })).toBeCloseTo(6283.19, 1);
  });
  it("have the load of a line that is nearest to its limit", () => {
    const line = (number: number, force: number, chip: number) =>
      AUDIT_COLUMNS.map(
        (name) => ({ line: number, peak_force_n_ratio: force, chip_mm_ratio: chip })[name as "line"] ?? 0,
      );
    const shares = sharesOf(new Float64Array([...line(4, 0.2, 0.5), ...line(7, 0, 0), ...line(4, 0.7, 0.1)]));
    expect([...shares]).toEqual([[4, { load: "peak_force_n", ratio: 0.7 }]]);
  });
});

describe("the verdict", () => {
  const nothing = {
    collisions: [],
    chips: [],
    strongest: undefined,
    wildest: undefined,
    audit: undefined,
    whole: true,
  };
  const strongest = { time: 3, line: 288, peakForce: 679 };
  it("is none before a cut, and of what was milled so far", () => {
    expect(judge(nothing)).toEqual({ sentence: "Nothing is cut yet.", damage: false, places: [] });
    expect(judge({ ...nothing, strongest, whole: false }).sentence).toBe("So far, no collision, no overloaded tooth.");
  });
  it("names a collision first, and calls it damage", () => {
    const collisions = [
      { time: 1, line: 9, what: "rapid through stock" },
      { time: 2, line: 9, what: "rapid through stock" },
    ];
    const judged = judge({ ...nothing, strongest, collisions });
    expect(judged.damage).toBe(true);
    expect(judged.places.map(({ words }) => words)).toEqual([
      "line 9: rapid through stock, and 1 more",
      "line 288: highest load, 679 N",
    ]);
  });
  it("says a collision once, where the audit knows it too", () => {
    const collisions = [{ time: 1, line: 9, what: "rapid through stock" }];
    const findings = [
      { outcome: "over", text: "line 9: rapid through stock", line: 9 },
      { outcome: "over", text: "line 9, T1: the cutter breaks", line: 9, ratio: [1.2, 1.5, 2] },
    ];
    const audit = { verdict: { outcome: "over", sentence: "No: it hits.", findings }, tools: [] } as never;
    expect(judge({ ...nothing, strongest, collisions, audit }).places.map(({ words }) => words)).toEqual([
      "line 9: rapid through stock",
      "line 9, T1: the cutter breaks",
      "line 288: highest load, 679 N",
    ]);
  });
  it("has at most three places, the worst ones", () => {
    const chips = [
      { line: 4, verdict: "rubbing", chip: 0.002, time: 1 },
      { line: 5, verdict: "overload", chip: 0.3, time: 2 },
      { line: 6, verdict: "overload", chip: 0.4, time: 3 },
    ] as const;
    const judged = judge({ ...nothing, strongest, chips, wildest: { time: 9, line: 8, multiplier: 1.2 } });
    expect(judged.sentence).toBe("The cut chatters.");
    expect(judged.places.map(({ line }) => line)).toEqual([8, 6, 288]);
    expect(judged.damage).toBe(false);
  });
  it("is that of the audit where there is one, and damage where the cutter breaks for sure", () => {
    const findings = [{ outcome: "over" as const, text: "line 5: the cutter breaks", line: 5 }];
    const tool = (low: number) => [
      { stress_n_per_mm2: { value: 900, ratio: [low, 2, 3] as [number, number, number] } },
    ];
    const audit = (low: number) =>
      ({
        verdict: { outcome: "over", sentence: "No: line 5, the cutter breaks.", findings },
        tools: tool(low),
      }) as never;
    const judged = judge({ ...nothing, strongest, audit: audit(1.5) });
    expect(judged.sentence).toBe("No: line 5, the cutter breaks.");
    expect(judged.damage).toBe(true);
    expect(judged.places[0]).toEqual({
      kind: "overload",
      words: "line 5: the cutter breaks",
      line: 5,
      time: undefined,
    });
    expect(judge({ ...nothing, strongest, audit: audit(0.9) }).damage).toBe(false);
  });
});

describe("the spread of deviations", () => {
  it("has all of them, those beyond its range at the ends", () => {
    const { bars, within, count } = spreadOf([-5, -0.1, 0, 0, 0.1, 5], 0.1, 0.05);
    expect(count).toBe(6);
    expect(within).toBeCloseTo(2 / 6, 12);
    expect(bars[0]).toBeCloseTo(2 / 6, 6);
    expect(bars[20]).toBeCloseTo(2 / 6, 6);
    expect(bars[40]).toBeCloseTo(2 / 6, 6);
  });
  it("has a full scale at which 98 of 100 differ in colour, and no lug hides the rest", () => {
    const cusps = Array.from({ length: 1000 }, (_, n) => 0.278 * (n / 999));
    expect(fullScaleOf(cusps)).toBe(0.3);
    expect(fullScaleOf([...cusps, ...Array.from({ length: 15 }, () => 3)])).toBe(0.3);
    expect(fullScaleOf(cusps.map((off) => -off / 100))).toBe(0.003);
    expect(fullScaleOf([0, 0])).toBe(0.001);
    expect(fullScaleOf([])).toBeUndefined();
  });
  it("of nothing is nothing", () => {
    expect(spreadOf([], 0.1, 0.05)).toMatchObject({ within: 0, count: 0 });
  });
});

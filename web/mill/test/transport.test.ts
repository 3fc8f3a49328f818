// SPDX-License-Identifier: MIT
// Speeds of the clock and problems along the program, without a browser.
import { describe, expect, it } from "vitest";

import { nextProblem, type Happened } from "../src/lanes/problems.js";
import { entryOf, LONGEST_S, Loop } from "../src/transport/loop.js";
import { chosenSpeed, Hurry, TrueSpeed } from "../src/transport/speeds.js";

describe("the speed", () => {
  it("is as chosen, or shows all in half a minute, within what the engine takes", () => {
    expect(chosenSpeed("0.5", 100)).toBe(0.5);
    expect(chosenSpeed("whole", 600)).toBe(20);
    expect(chosenSpeed("whole", 6)).toBe(0.2);
    expect(chosenSpeed("whole", 1e9)).toBe(1000);
    expect(chosenSpeed("whole", 0)).toBeGreaterThan(0);
  });
  it("doubles again and again through air, and is as chosen in the cut", () => {
    const hurry = new Hurry();
    expect(hurry.factor(5, true)).toBe(1);
    expect([5, 5.25, 5.5, 6].map((now) => hurry.factor(now, false))).toEqual([1, 2, 4, 16]);
    expect(hurry.factor(100, false)).toBe(64);
    expect(hurry.factor(100.1, true)).toBe(1);
    expect(hurry.factor(200, false)).toBe(1);
  });
  it("is said where the part cannot follow", () => {
    const run = (share: number) => {
      const speed = new TrueSpeed();
      let said: number | undefined;
      for (let n = 0; n <= 200; ++n) said = speed.add(n / 60, (share * 10 * n) / 60, 10);
      return said;
    };
    expect(run(1)).toBeUndefined();
    expect(run(0.9)).toBeUndefined();
    expect(run(0.3)).toBeCloseTo(3, 6);
    const speed = new TrueSpeed();
    speed.add(0, 0, 10);
    expect(speed.add(2, 1, 10)).toBe(0.5);
    // The clock was set back.
    expect(speed.add(3, 0.5, 10)).toBeUndefined();
  });
});

describe("the next problem", () => {
  const events: Happened[] = [
    { time: 8, what: "rubbing" },
    { time: 9, what: "overload" },
    { time: 9.5, what: "overload" },
    { time: 3, what: "damage" },
    { time: 20, what: "overload" },
  ];
  it("is the begin of a stretch, and after the last one the first", () => {
    const from = (time: number) => nextProblem(events, time)?.time;
    expect([0, 3, 8, 9, 19, 25].map(from)).toEqual([3, 9, 9, 20, 20, 3]);
  });
  it("is where teeth rub if nothing is worse, and nowhere in a good cut", () => {
    expect(nextProblem([{ time: 8, what: "rubbing" }], 0)?.time).toBe(8);
    expect(nextProblem([], 0)).toBeUndefined();
  });
});

describe("the loop", () => {
  // Two cuts, the second with a short gap.
  const rows = [
    { time: 1, duration: 0.5 },
    { time: 1.5, duration: 0.5 },
    { time: 4, duration: 1 },
    { time: 5.02, duration: 1 },
  ];
  it("begins where the tool enters", () => {
    expect([1, 1.7, 2, 4.5, 5.5, 6].map((time) => entryOf(rows, time))).toEqual([1, 1, 1, 4, 4, 4]);
    expect(entryOf([], 3)).toBe(3);
    // A cut of a minute is not played from its entry.
    const long = Array.from({ length: 600 }, (_, n) => ({ time: n / 10, duration: 0.1 }));
    expect(entryOf(long, 59)).toBeCloseTo(59 - LONGEST_S, 0);
  });
  it("goes back once the tool has left, and once only until the clock has obeyed", () => {
    const loop = new Loop(() => rows);
    const played = [0.5, 4.2, 5.01, 5.5, 6, 6.03, 6.1, 6.12, 4, 4.5, 6.2];
    const went = played.map((time) => [time, loop.next(time, false)]).filter(([, to]) => to !== undefined);
    expect(went).toEqual([
      [6.1, 4],
      [6.2, 4],
    ]);
    loop.forget();
    expect(loop.next(3, false)).toBeUndefined();
    expect(loop.next(1.2, false)).toBeUndefined();
    expect(loop.next(1.9, true)).toBe(1);
  });
  it("goes back from within a cut that is too long", () => {
    const loop = new Loop(() => [{ time: 10, duration: 1000 }]);
    expect(loop.next(12, false)).toBeUndefined();
    expect(loop.next(10.5 + LONGEST_S, false)).toBe(10);
  });
});

// SPDX-License-Identifier: MIT
import { deflateRawSync } from "node:zlib";

import { afterEach, describe, expect, it, vi } from "vitest";

import { liveUrl } from "../src/sources/connection.js";
import { growthColour } from "../src/sight/chatter_colours.js";
import { verdict } from "../src/panels/chatter.js";
import { History, overTime } from "../src/panels/history.js";
import { heat } from "../src/sight/heat.js";
import { sort, tooLarge } from "../src/sources/drop.js";
import { unpacked } from "../src/sources/tools.js";
import { diverging, HeatMap } from "../src/sight/heat_map.js";
import { readRecording, Recorder } from "@tribo/protocol/recording";
import { Replay } from "../src/sources/replay.js";
import type { Listener } from "../src/sources/source.js";
import { waysOf } from "../src/sight/path_lines.js";
import { outline } from "../src/sight/tool.js";
import { spectrum, turn } from "../src/panels/turn.js";
import type { Row } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";

describe("heat", () => {
  const lightness = ([r, g, b]: Vec3) => 0.2126 * r ** 2.2 + 0.7152 * g ** 2.2 + 0.0722 * b ** 2.2;
  it("grows lighter all the way", () => {
    for (let n = 1; n <= 40; ++n) expect(lightness(heat(n / 40))).toBeGreaterThan(lightness(heat((n - 1) / 40)));
  });
  it("stays on its scale", () => {
    expect(heat(-1)).toEqual(heat(0));
    expect(heat(2)).toEqual(heat(1));
  });
});

describe("a plot over time", () => {
  const cut = (time: number, peakForce: number) => ({ time, duration: 1, peakForce }) as Row;
  const peak = (row: Row) => row.peakForce;
  it("has no line where nothing is cut", () => {
    const rounding = 2 ** -12;
    const rows = [cut(0, 5), cut(1 + rounding, 6), cut(4, 7)];
    expect(overTime(rows, peak)).toEqual([
      [0, 1 + rounding, 2 + rounding, 4],
      [5, 6, null, 7],
    ]);
  });
  it("shows the largest of many rows", () => {
    const rows = Array.from({ length: 5000 }, (_, n) => cut(n, n === 4321 ? 99 : 1));
    const [times, peaks] = overTime(rows, peak);
    expect(times.length).toBeLessThan(2000);
    expect(Math.max(...peaks!.map(Number))).toBe(99);
  });
});

describe("the drawn path", () => {
  it("has each way once, as a rapid or as a feed", () => {
    const rapid = new Uint8Array([1, 1, 0, 0, 1]);
    expect(waysOf(rapid, true)).toEqual([0, 1, 3, 4]);
    expect(waysOf(rapid, false)).toEqual([1, 2, 2, 3]);
    expect(waysOf(new Uint8Array(1), true)).toEqual([]);
  });
});

describe("the colours of multipliers", () => {
  it("differ in lightness where the verdict differs, and are none where nothing is known", () => {
    const lightness = ([r, g, b]: Vec3) => 0.2126 * r ** 2.2 + 0.7152 * g ** 2.2 + 0.0722 * b ** 2.2;
    const all = [0.5, 0.95, 1.1, 2].map((multiplier) => growthColour(multiplier)!);
    const sorted = all.map(lightness).sort((a, b) => a - b);
    for (let n = 1; n < sorted.length; ++n) expect(sorted[n]! / sorted[n - 1]!).toBeGreaterThan(1.2);
    expect(growthColour(1)).toEqual(all[1]);
    expect(growthColour(0)).toBeUndefined();
  });
  it("come with words", () => {
    expect(verdict(1.14, 897.6)).toBe("chatters at 898 Hz");
    expect(verdict(0.69, 906)).toBe("stable");
    expect(verdict(0, 0)).toBe("not known here");
  });
});

describe("outline", () => {
  const tool = { number: 1, flutes: 2, radius: 5, corner: 0, length: 30, holder: [{ radius: 12, length: 20 }] };
  it("of a flat end mill has a square corner and its holder", () => {
    expect(outline(tool)).toEqual([
      [0, 0],
      [5, 0],
      [5, 30],
      [12, 30],
      [12, 50],
      [0, 50],
    ]);
  });
  it("of a ball lies on the ball", () => {
    const low = outline({ ...tool, corner: 5, holder: [] }).filter(([, z]) => z <= 5);
    expect(low.length).toBeGreaterThan(3);
    for (const [r, z] of low) expect(Math.hypot(r, z - 5)).toBeCloseTo(5, 9);
  });
});

describe("liveUrl", () => {
  it("is beside the page and keeps its token", () => {
    expect(liveUrl({ protocol: "http:", host: "127.0.0.1:8317", search: "" })).toBe("ws://127.0.0.1:8317/live");
    expect(liveUrl({ protocol: "https:", host: "mill", search: "?token=a%26b" })).toBe("wss://mill/live?token=a%26b");
  });
});

describe("chip load", () => {
  const row = {
    time: 0,
    duration: 0.1,
    tip: [0, 0, 0] as [number, number, number],
    meanForce: 1,
    peakForce: 2,
    torque: 0,
    depth: 1,
    feedPerTooth: 0.1,
    line: 1,
    entry: 0,
    exit: Math.PI,
    chip: 0.1,
    chipVerdict: "" as const,
    multiplier: 0,
    rpm: 6000,
    axis: [0, 0, 1] as [number, number, number],
    cutter: 0,
    peakLow: 0,
    peakHigh: 0,
  };
  it("lists each line once for what it does wrong, by its worst chip", () => {
    const map = new HeatMap();
    const ball = { number: 1, flutes: 2, radius: 3, corner: 3, length: 20, holder: [] };
    map.begin([ball]);
    for (const [line, chip, time, chipVerdict] of [
      [7, 0.3, 1, "overload"],
      [7, 0.4, 2, "overload"],
      [7, 0.2, 3, "overload"],
      [4, 0.008, 4, "rubbing"],
      [4, 0.1, 5, ""],
      [4, 0.002, 6, "rubbing"],
    ] as const)
      map.add({ ...row, line, chip, time, chipVerdict });
    expect(map.chipMarks()).toEqual([
      { line: 4, verdict: "rubbing", chip: 0.002, time: 6 },
      { line: 7, verdict: "overload", chip: 0.4, time: 2 },
    ]);
    map.begin([ball]);
    expect(map.chipMarks()).toEqual([]);
  });
  it("colours a point by the latest cut that made it", () => {
    const map = new HeatMap();
    const ball = { number: 1, flutes: 2, radius: 3, corner: 3, length: 20, holder: [] };
    map.begin([ball]);
    map.add({ ...row, peakForce: 10 });
    map.add({ ...row, tip: [0, 5, 0], peakForce: 20 });
    // The lowest points of either ball, and one that neither made.
    expect(map.colour("force", [0, 0, 0], Number.NaN)).toEqual(heat(0.5));
    expect(map.colour("force", [0, 5, 0], Number.NaN)).toEqual(heat(1));
    expect(map.colour("force", [0, 0, 40], Number.NaN)).toBeUndefined();
  });
  it("colours a point by the multiplier of its cut, also where it comes later", () => {
    const map = new HeatMap();
    const ball = { number: 1, flutes: 2, radius: 3, corner: 3, length: 20, holder: [] };
    map.begin([ball]);
    const history = new History();
    history.addRows([{ ...row }]);
    map.add(history.rows[0]!);
    expect(map.colour("chatter", [0, 0, 0], Number.NaN)).toBeUndefined();
    expect(history.addMultipliers(0, new Float32Array([1.25, 7]))).toHaveLength(1);
    expect(map.colour("chatter", [0, 0, 0], Number.NaN)).toEqual(growthColour(1.25));
  });
  it("colours a point by how far it is off the designed surface, where that is known", () => {
    const map = new HeatMap();
    expect(map.colour("deviation", [0, 0, 0], 0.05)).toEqual(diverging(0.5));
    expect(map.colour("deviation", [0, 0, 0], -0.05)).toEqual(diverging(-0.5));
    expect(map.colour("scallop", [0, 0, 0], 0.05)).toEqual(heat(0.5));
    expect(map.colour("deviation", [0, 0, 0], Number.NaN)).toBeUndefined();
  });
});

describe("a turn of the spindle", () => {
  // Mean 5 N along the feed, and 2 * 3 N cos(2 angle) across it.
  const piece = {
    time: 0,
    duration: 1,
    tip: [0, 0, 0] as [number, number, number],
    angle: 0,
    radPerS: 2 * Math.PI * 100,
    pace: 1,
    chips: 0,
    orderStep: 2,
    harmonics: new Float32Array([5, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0]),
  };
  it("is the sum of its harmonics", () => {
    const t = turn(piece, 4);
    t.x.forEach((v) => expect(v).toBeCloseTo(5, 12));
    [6, -6, 6, -6, 6].forEach((v, n) => expect(t.y[n]).toBeCloseTo(v, 12));
  });
  it("has its line where the teeth pass", () => {
    expect(spectrum(piece)).toEqual({ hz: [200], newton: [6] });
  });
});

describe("a recording", () => {
  it("gives back what was put in", async () => {
    const recorder = new Recorder();
    recorder.take(new Uint8Array([1, 2, 3, 4]).buffer);
    recorder.take(new Uint8Array([5, 6, 7, 8, 9, 10, 11, 12]).buffer);
    const bytes = await recorder.file().arrayBuffer();
    expect(readRecording(bytes).map((r) => [...new Uint8Array(r.bytes)])).toEqual([
      [1, 2, 3, 4],
      [5, 6, 7, 8, 9, 10, 11, 12],
    ]);
    expect(() => readRecording(bytes.slice(0, bytes.byteLength - 3))).toThrow("cut off");
    expect(() => readRecording(new ArrayBuffer(40))).toThrow("no recording");
  });
});

describe("a replay", () => {
  afterEach(() => void vi.useRealTimers());

  function frame(kind: number, length: number): ArrayBuffer {
    const bytes = new ArrayBuffer(length);
    new Uint8Array(bytes).set([kind, 1]);
    return bytes;
  }

  it("can be paused, goes on, and says so when it is over, whatever comes last", () => {
    vi.useFakeTimers();
    const told: string[] = [];
    const listener = {
      frame: (now) => told.push(now.kind === "state" ? (now.playing ? "plays" : "stands") : now.kind),
      line: () => undefined,
      info: () => undefined,
    } as Partial<Listener> as Listener;
    const state = frame(3, 96);
    const collision = frame(5, 36);
    const frames = [0, 0.2, 0.4].map((seconds) => ({ seconds, bytes: state }));
    const replay = new Replay(listener, [...frames, { seconds: 0.6, bytes: collision }], "run.tribo");
    const after = (ms: number) => (vi.advanceTimersByTime(ms), told.splice(0));
    expect(after(300)).toEqual(["plays", "plays"]);
    replay.send({ op: "pause" });
    expect(after(1000)).toEqual(["stands"]);
    replay.send({ op: "play" });
    expect(after(1000)).toEqual(["plays", "plays", "collision", "stands"]);
    replay.send({ op: "play" });
    expect(after(300)).toEqual(["plays", "plays", "plays"]);
    replay.close();
  });
});

describe("a drop", () => {
  const file = (name: string) => ({ name, bytes: new ArrayBuffer(0) });
  it("is a job, a program with a model, or a model for what is there", () => {
    expect(sort([file("a/bowl.csv"), file("a/bowl.toml")], undefined)).toMatchObject({
      order: { job: "a/bowl.toml", part: "" },
    });
    expect(sort([file("p.nc"), file("s.wrl")], undefined)).toMatchObject({ order: { job: "p.nc", part: "s.wrl" } });
    const before = { files: [file("p.nc")], job: "p.nc", part: "", cell: 0 };
    expect(sort([file("s.stl")], before)).toMatchObject({ order: { job: "p.nc", part: "s.stl" } });
    expect(sort([file("run.tribo")], undefined)).toMatchObject({ recording: { name: "run.tribo" } });
  });
  it("of a chain of set-ups is the last job", () => {
    const job = (name: string, text: string) => ({ name, bytes: new TextEncoder().encode(text).buffer });
    const first = job("p/a.toml", "[stock]\nbox_mm = 1");
    const second = job("p/b.toml", "[stock]\nfrom = 'a.toml'");
    const third = job("p/c.toml", '[stock]\nfrom="../p/b.toml"');
    expect(sort([third, first, second], undefined)).toMatchObject({ order: { job: "p/c.toml" } });
    expect(sort([second, first], undefined)).toMatchObject({ order: { job: "p/b.toml" } });
    const round = job("p/a.toml", '[stock]\nfrom = "b.toml"');
    expect(sort([second, round], undefined)).toMatchObject({
      refused: expect.stringContaining("the stock of another"),
    });
  });
  it("has a tool library beside a program, or for the program that is there", () => {
    const csv = (name: string, text: string) => ({ name, bytes: new TextEncoder().encode(text).buffer });
    const table = csv("tools.csv", "number,diameter_mm\n1,6\n");
    expect(sort([table, file("p.nc")], undefined)).toMatchObject({ order: { job: "p.nc" } });
    expect(sort([file("mill.tbl"), file("O1000")], undefined)).toMatchObject({ order: { job: "O1000" } });
    expect(sort([csv("path.csv", "x,y,z,i,j,k\n")], undefined)).toMatchObject({ order: { job: "path.csv" } });
    const before = { files: [file("p.nc"), file("old.tbl")], job: "p.nc", part: "", cell: 0 };
    expect(sort([table], before)).toMatchObject({ order: { files: [{ name: "p.nc" }, table], job: "p.nc" } });
    for (const [files, order, why] of [
      [[table], undefined, "alone says no path"],
      [[table], { ...before, job: "p.toml" }, "write tools = 'tools.csv'"],
      [[table, file("a.tbl"), file("p.nc")], undefined, "2 tool libraries"],
    ] as const) {
      expect(sort([...files], order)).toMatchObject({ refused: expect.stringContaining(why) });
    }
  });
  it("has the library of Fusion unpacked", async () => {
    const json = '{"data":[{"type":"flat end mill"}]}'.repeat(9);
    // A directory entry, then the file, stored and deflated.
    const zip = (method: number) => {
      const packed = method === 0 ? Buffer.from(json) : deflateRawSync(json);
      const entry = (name: string, data: Buffer, at: number) => {
        const local = Buffer.alloc(30);
        local.writeUInt32LE(0x04034b50, 0);
        local.writeUInt16LE(name.length, 26);
        const central = Buffer.alloc(46);
        central.writeUInt32LE(0x02014b50, 0);
        central.writeUInt16LE(method, 10);
        central.writeUInt32LE(data.length, 20);
        central.writeUInt16LE(name.length, 28);
        central.writeUInt32LE(at, 42);
        return {
          local: Buffer.concat([local, Buffer.from(name), data]),
          central: Buffer.concat([central, Buffer.from(name)]),
        };
      };
      const folder = entry("tools/", Buffer.alloc(0), 0);
      const tools = entry("tools/tools.json", packed, folder.local.length);
      const end = Buffer.alloc(22);
      end.writeUInt32LE(0x06054b50, 0);
      end.writeUInt16LE(2, 10);
      end.writeUInt32LE(folder.local.length + tools.local.length, 16);
      return new Uint8Array(Buffer.concat([folder.local, tools.local, folder.central, tools.central, end])).buffer;
    };
    for (const method of [0, 8]) {
      const { name, bytes } = await unpacked({ name: "My.tools", bytes: zip(method) });
      expect(name).toBe("My.tools");
      expect(new TextDecoder().decode(bytes)).toBe(json);
    }
    const plain = { name: "My.tools", bytes: new TextEncoder().encode(json).buffer };
    expect(await unpacked(plain)).toBe(plain);
  });
  it("is refused in words", () => {
    expect(sort([file("a.toml"), file("b.toml")], undefined)).toMatchObject({
      refused: expect.stringContaining("2 jobs"),
    });
    expect(sort([file("s.stl")], undefined)).toMatchObject({
      refused: expect.stringContaining("together with a program"),
    });
    const large = [{ name: "big.nc", size: 100e6 }];
    expect(tooLarge(large, false)).toMatch(/^big.nc: 100 MB are .*try: tribo render, or tribo live/);
    expect(tooLarge(large, true)).toMatch(
      /^big.nc: 100 MB are .*start the engine anew with this file: tribo live big.nc$/,
    );
    expect(tooLarge([{ name: "small.nc", size: 1e6 }], true)).toBe("");
  });
});

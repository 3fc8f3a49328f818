// SPDX-License-Identifier: MIT
// The binary frames of the live view (docs/live-protocol.md, src/protocol/live_frame.hpp), decoded. Lengths in mm.

import type { Axis, Vec3 } from "./vec3.js";

export const FRAME_VERSION = 1;

export interface Cutter {
  number: number;
  flutes: number;
  radius: number;
  corner: number;
  length: number;
  holder: { radius: number; length: number }[];
  // Points (radius, height above the tip) of a cutter that is not flat, ball or bull, from the bottom up to its length.
  outline?: [number, number][];
}

export interface JobFrame {
  kind: "job";
  duration: number;
  cell: number;
  blank: { min: Vec3; max: Vec3 };
  cutters: Cutter[];
  chipLimits: ChipLimits | undefined;
}

// Limits for chips. Earlier engines do not send them.
export interface ChipLimits {
  // A thinner chip rubs, mm.
  rubbing: number;
  // A larger share of the cutter diameter overloads a tooth.
  overloadShare: number;
}

export interface PathFrame {
  kind: "path";
  times: Float32Array;
  points: Float32Array;
  rapid: Uint8Array;
  // Of the way that ends at the point. Earlier engines do not send it: then 0.
  lines: Uint32Array;
}

export interface ChunkFrame {
  kind: "chunk";
  chunk: Vec3;
  positions: Float32Array;
  indices: Uint16Array;
  // Distance of each vertex from the designed surface, mm, negative in a gouge; NaN far from it. Empty: no designed
  // surface.
  deviations: Float32Array;
  // The first vertices lie on the surface of the blank, so many; a triangle of them alone is untouched. Undefined:
  // earlier engines do not send it.
  onBlank: number | undefined;
  // Drawn in a hurry, without deviations: it comes again, exact, while the part stays as it is.
  rough: boolean;
}

export interface StateFrame {
  kind: "state";
  time: number;
  tip: Vec3;
  axis: Vec3;
  force: Vec3;
  peakForce: number;
  torque: number;
  rpm: number;
  feed: number;
  angle: number;
  removed: number;
  milled: number;
  speed: number;
  line: number;
  cutter: number;
  cutting: boolean;
  playing: boolean;
  rapid: boolean;
  // Of the cut, where something bends.
  chatter: { multiplier: number; hz: number; depth: number } | undefined;
}

export type ChipVerdict = "" | "rubbing" | "overload";

export interface Row {
  time: number;
  duration: number;
  tip: Vec3;
  meanForce: number;
  peakForce: number;
  torque: number;
  entry: number;
  exit: number;
  depth: number;
  feedPerTooth: number;
  line: number;
  // The thickest chip. Earlier engines do not send it: then 0, and no verdict.
  chip: number;
  chipVerdict: ChipVerdict;
  // Of a MultipliersFrame; 0: none.
  multiplier: number;
  // As the spindle turns. Earlier engines do not send it, nor the next two: then 0, upright, and the first.
  rpm: number;
  axis: Vec3;
  // Index into JobFrame.cutters.
  cutter: number;
  // The band in which the true peak force lies, N. Earlier engines do not send it: then 0.
  peakLow: number;
  peakHigh: number;
}

export interface RowsFrame {
  kind: "rows";
  // All earlier rows are invalid.
  anew: boolean;
  rows: Row[];
}

// The text in whose lines rows and state count.
export interface ProgramFrame {
  kind: "program";
  name: string;
  text: string; // empty: too long to be sent
}

export interface CollisionFrame {
  kind: "collision";
  time: number;
  what: string;
  line: number;
  tip: Vec3;
}

// A piece of the cut, for the sound and the plots of a turn.
export interface Piece {
  time: number;
  duration: number;
  tip: Vec3;
  angle: number;
  radPerS: number;
  // Program seconds per second of the unchanged program.
  pace: number;
  chips: number;
  orderStep: number;
  // The mean first. Each has re x, im x, re y, im y, re z, im z, in N, in the frame of the tool.
  harmonics: Float32Array;
}

export interface SoundFrame {
  kind: "sound";
  pieces: Piece[];
}

export interface FingerFrame {
  kind: "finger";
  hand: Vec3;
  proxy: Vec3;
  force: Vec3;
  slip: number;
  contact: boolean;
  on: boolean;
  cutMode: boolean;
  stopped: boolean;
  // True if a hand holds the probe.
  present: boolean;
}

export type Quantiles = [number, number, number, number];

export interface ServoFrame {
  kind: "servo";
  ticks: number;
  late: number;
  fault: string; // empty: none
  rate: number;
  limit: number;
  largest: number;
  // Median, 99 %, 99.9 %, maximum; in microseconds.
  lateness: Quantiles;
  cpu: Quantiles;
}

export interface TextureFrame {
  kind: "texture";
  // Three corners and a force each.
  triangles: { corners: [Vec3, Vec3, Vec3]; force: Vec3 }[];
}

export interface ListeningFrame {
  kind: "listening";
  listener: Vec3;
}

export interface DesignedFrame {
  kind: "designed";
  positions: Float32Array;
  indices: Uint16Array;
}

// What bends; only the ear reads it.
export interface BendingFrame {
  kind: "bending";
}

// Multipliers of the rows from the `first` on, by their number since all were sent. 0: none.
export interface MultipliersFrame {
  kind: "multipliers";
  first: number;
  multipliers: Float32Array;
}

// Where the cut at the clock chatters.
export interface ChartFrame {
  kind: "chart";
  // Speeds: fromRpm + n stepRpm; depths: (n + 1) stepMm.
  fromRpm: number;
  stepRpm: number;
  stepMm: number;
  depths: number;
  // One per speed; 0: not computed yet; NaN: stable to the last depth.
  limits: Float32Array;
  // Speed by speed, all depths of each; 0: not computed yet.
  multipliers: Float32Array;
  // The deepest first.
  pockets: { rpm: number; depth: number }[];
}

// An unknown kind; newer engines may send others.
export interface OtherFrame {
  kind: "other";
}

export type Frame =
  | JobFrame
  | ChunkFrame
  | StateFrame
  | RowsFrame
  | CollisionFrame
  | SoundFrame
  | FingerFrame
  | ServoFrame
  | TextureFrame
  | ListeningFrame
  | DesignedFrame
  | PathFrame
  | BendingFrame
  | MultipliersFrame
  | ChartFrame
  | ProgramFrame
  | OtherFrame;

const COLLISIONS = ["rapid through stock", "shank in stock", "holder in stock", "tool in fixture", "holder in fixture"];

const FAULTS = [
  "",
  "the device is silent",
  "the simulation stalled",
  "the clock jumped",
  "a force was no number",
  "too fast",
  "the arm switched its motors off",
];

const CHIP_VERDICTS: ChipVerdict[] = ["", "rubbing", "overload"];

// Programs are UTF-8 or, from older controls, Latin-1.
function decodeText(bytes: Uint8Array): string {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

class Reader {
  at = 16;
  constructor(private readonly view: DataView) {}
  u32(): number {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }
  i32(): number {
    this.at += 4;
    return this.view.getInt32(this.at - 4, true);
  }
  f32(): number {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }
  f64(): number {
    this.at += 8;
    return this.view.getFloat64(this.at - 8, true);
  }
  vec3(): Vec3 {
    return [this.f32(), this.f32(), this.f32()];
  }
  text(): string {
    const length = this.u32();
    if (length > this.left()) throw new RangeError("a text is cut off");
    const bytes = new Uint8Array(this.view.buffer, this.view.byteOffset + this.at, length);
    this.at += 4 * Math.ceil(length / 4);
    return decodeText(bytes);
  }
  left(): number {
    return this.view.byteLength - this.at;
  }
}

// Throws a RangeError for a truncated frame, an Error for another version.
export function decodeFrame(buffer: ArrayBuffer): Frame {
  const view = new DataView(buffer);
  const kind = view.getUint8(0);
  if (view.getUint8(1) !== FRAME_VERSION) throw new Error(`frames of version ${view.getUint8(1)} are not known`);
  const time = view.getFloat64(8, true);
  const r = new Reader(view);
  switch (kind) {
    case 1:
      return decodeJob(r);
    case 2:
      return decodeChunk(r, buffer);
    case 3:
      return decodeState(r, time);
    case 4:
      return { kind: "rows", anew: (view.getUint8(2) & 1) !== 0, rows: decodeRows(r) };
    case 5: {
      const what = COLLISIONS[r.i32()] ?? "collision";
      const line = r.i32();
      return { kind: "collision", time, what, line, tip: r.vec3() };
    }
    case 6: {
      const pieces: Piece[] = [];
      for (let n = r.u32(); n > 0; --n) pieces.push(decodePiece(r));
      return { kind: "sound", pieces };
    }
    case 7:
      return decodeFinger(r);
    case 8:
      return decodeServo(r);
    case 9: {
      const triangles: TextureFrame["triangles"] = [];
      while (r.left() >= 48) triangles.push({ corners: [r.vec3(), r.vec3(), r.vec3()], force: r.vec3() });
      return { kind: "texture", triangles };
    }
    case 10:
      return { kind: "listening", listener: r.vec3() };
    case 11:
      return { kind: "designed", ...decodeMesh(r, buffer) };
    case 12:
      return decodePath(r);
    case 13:
      return { kind: "bending" };
    case 14:
      return decodeMultipliers(r);
    case 15:
      return decodeChart(r);
    case 16:
      return { kind: "program", name: r.text(), text: r.text() };
    default:
      return { kind: "other" };
  }
}

function decodeJob(r: Reader): JobFrame {
  const duration = r.f64();
  const cell = r.f32();
  const blank = { min: r.vec3(), max: r.vec3() };
  const cutters: Cutter[] = [];
  for (let n = r.u32(); n > 0; --n) {
    const cutter: Cutter = {
      number: r.i32(),
      flutes: r.u32(),
      radius: r.f32(),
      corner: r.f32(),
      length: r.f32(),
      holder: [],
    };
    for (let steps = r.u32(); steps > 0; --steps) cutter.holder.push({ radius: r.f32(), length: r.f32() });
    cutters.push(cutter);
  }
  const chipLimits = r.left() > 0 ? { rubbing: r.f32(), overloadShare: r.f32() } : undefined;
  for (let n = r.left() > 0 ? r.u32() : 0, k = 0; k < n; ++k) {
    const outline: [number, number][] = [];
    for (let points = r.u32(); points > 0; --points) outline.push([r.f32(), r.f32()]);
    const cutter = cutters[k];
    if (cutter && outline.length > 0) cutter.outline = outline;
  }
  return { kind: "job", duration, cell, blank, cutters, chipLimits };
}

function decodePath(r: Reader): PathFrame {
  const count = r.u32();
  const path: PathFrame = {
    kind: "path",
    times: new Float32Array(count),
    points: new Float32Array(3 * count),
    rapid: new Uint8Array(count),
    lines: new Uint32Array(count),
  };
  for (let n = 0; n < count; ++n) {
    path.times[n] = r.f32();
    path.points.set(r.vec3(), 3 * n);
    path.rapid[n] = r.u32();
  }
  for (let n = 0; n < count && r.left() > 0; ++n) path.lines[n] = r.u32();
  return path;
}

function decodeChunk(r: Reader, buffer: ArrayBuffer): ChunkFrame {
  const chunk: Vec3 = [r.i32(), r.i32(), r.i32()];
  const mesh = decodeMesh(r, buffer);
  const compared = r.left() > 0 ? r.u32() : 0;
  const deviations = new Float32Array(buffer, r.at, compared);
  r.at += 4 * compared;
  const onBlank = r.left() > 0 ? r.u32() : undefined;
  return { kind: "chunk", chunk, ...mesh, deviations, onBlank, rough: r.left() > 0 && r.u32() !== 0 };
}

function decodeMesh(r: Reader, buffer: ArrayBuffer): { positions: Float32Array; indices: Uint16Array } {
  const vertices = r.u32();
  const triangles = r.u32();
  const origin = r.vec3();
  const step = r.f32();
  const packed = new Uint16Array(buffer, r.at, 3 * vertices);
  const positions = new Float32Array(3 * vertices);
  for (let n = 0; n < packed.length; ++n) positions[n] = origin[(n % 3) as Axis] + step * packed[n]!;
  const begin = r.at + 4 * Math.ceil((6 * vertices) / 4);
  r.at = begin + 4 * Math.ceil((6 * triangles) / 4);
  return { positions, indices: new Uint16Array(buffer, begin, 3 * triangles) };
}

function decodePiece(r: Reader): Piece {
  const piece = {
    time: r.f64(),
    duration: r.f32(),
    tip: r.vec3(),
    angle: r.f32(),
    radPerS: r.f32(),
    pace: r.f32(),
    chips: r.f32(),
    orderStep: r.i32(),
  };
  const harmonics = new Float32Array(6 * r.u32());
  for (let n = 0; n < harmonics.length; ++n) harmonics[n] = r.f32();
  return { ...piece, harmonics };
}

function decodeMultipliers(r: Reader): MultipliersFrame {
  const first = r.u32();
  const multipliers = new Float32Array(r.u32());
  for (let n = 0; n < multipliers.length; ++n) {
    multipliers[n] = r.f32();
    r.f32(); // its frequency
  }
  return { kind: "multipliers", first, multipliers };
}

function decodeChart(r: Reader): ChartFrame {
  const floats = () => Float32Array.from({ length: r.u32() }, () => r.f32());
  const [fromRpm, stepRpm, stepMm, depths] = [r.f32(), r.f32(), r.f32(), r.u32()];
  const [limits, multipliers] = [floats(), floats()];
  const pockets = Array.from({ length: r.u32() }, () => ({ rpm: r.f32(), depth: r.f32() }));
  return { kind: "chart", fromRpm, stepRpm, stepMm, depths, limits, multipliers, pockets };
}

function decodeFinger(r: Reader): FingerFrame {
  const finger = { kind: "finger" as const, hand: r.vec3(), proxy: r.vec3(), force: r.vec3(), slip: r.f32() };
  const flags = r.u32();
  const flag = (bit: number) => (flags & bit) !== 0;
  return { ...finger, contact: flag(1), on: flag(2), cutMode: flag(4), stopped: flag(8), present: flag(16) };
}

function decodeServo(r: Reader): ServoFrame {
  const four = (): Quantiles => [r.f32(), r.f32(), r.f32(), r.f32()];
  const [ticks, late, fault] = [r.u32(), r.u32(), r.u32()];
  const [rate, limit, largest] = [r.f32(), r.f32(), r.f32()];
  return {
    kind: "servo",
    ticks,
    late,
    fault: FAULTS[fault] ?? "fault",
    rate,
    limit,
    largest,
    lateness: four(),
    cpu: four(),
  };
}

function decodeState(r: Reader, time: number): StateFrame {
  const state = {
    kind: "state" as const,
    time,
    tip: r.vec3(),
    axis: r.vec3(),
    force: r.vec3(),
    peakForce: r.f32(),
    torque: r.f32(),
    rpm: r.f32(),
    feed: r.f32(),
    angle: r.f32(),
    removed: r.f32(),
    milled: r.f32(),
    speed: r.f32(),
    line: r.u32(),
    cutter: r.u32(),
  };
  const flags = r.u32();
  const bends = r.left() >= 16 && r.u32() === 1;
  const chatter = bends ? { multiplier: r.f32(), hz: r.f32(), depth: r.f32() } : undefined;
  return { ...state, cutting: (flags & 1) !== 0, playing: (flags & 2) !== 0, rapid: (flags & 4) !== 0, chatter };
}

function decodeRows(r: Reader): Row[] {
  const rows: Row[] = [];
  for (let n = r.u32(); n > 0; --n) rows.push(decodeRow(r));
  if (r.left() === 0) return rows;
  for (const row of rows) {
    row.chip = r.f32();
    row.chipVerdict = CHIP_VERDICTS[r.u32()] ?? "";
  }
  if (r.left() === 0) return rows;
  const low = r.f32();
  const high = r.f32();
  for (const row of rows) {
    Object.assign(row, { rpm: r.f32(), axis: r.vec3(), cutter: r.u32() });
    setBand(row, low, high);
  }
  // Those from cases, if there are: they replace that of all rows.
  if (r.left() >= 4 && r.u32() === rows.length) for (const row of rows) setBand(row, r.f32(), r.f32());
  return rows;
}

// By factors on the force.
function setBand(row: Row, low: number, high: number): void {
  row.peakLow = row.peakForce * low;
  row.peakHigh = row.peakForce * high;
}

function decodeRow(r: Reader): Row {
  return {
    time: r.f64(),
    duration: r.f32(),
    tip: r.vec3(),
    meanForce: r.f32(),
    peakForce: r.f32(),
    torque: r.f32(),
    entry: r.f32(),
    exit: r.f32(),
    depth: r.f32(),
    feedPerTooth: r.f32(),
    line: r.u32(),
    chip: 0,
    chipVerdict: "",
    multiplier: 0,
    rpm: 0,
    axis: [0, 0, 1],
    cutter: 0,
    peakLow: 0,
    peakHigh: 0,
  };
}

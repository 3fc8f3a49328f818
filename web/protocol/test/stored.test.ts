// SPDX-License-Identifier: MIT
// The frames that the engine's own test stores (tests/protocol/live_frame_test.cpp), decoded: the page reads from the
// same bytes what the engine says is in them.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";

import { ROOT } from "../../tools/places.js";
import { decodeFrame, type Frame } from "../src/frames.js";

type Told = Record<string, unknown>;

const FOLDER = join(ROOT, "tests/protocol/frames");

function decoded(name: string): Frame {
  const { buffer, byteOffset, byteLength } = readFileSync(join(FOLDER, `${name}.bin`));
  return decodeFrame(buffer.slice(byteOffset, byteOffset + byteLength));
}

const list = (told: unknown) => told as Told[];
const flat = (told: unknown) => (told as unknown[]).flat(2) as number[];

const mesh = (told: Told) => ({
  positions: new Float32Array(flat(told.positions_mm)),
  indices: new Uint16Array(flat(told.triangles)),
});

const chatter = (told: Told | undefined) =>
  told && {
    multiplier: told.multiplier as number,
    hz: told.chatter_hz as number,
    depth: told.axial_depth_mm as number,
  };
const floats = (told: unknown) => Float32Array.from(told as (number | null)[], (value) => value ?? Number.NaN);

// Of a cutter with a profile.
const outline = (told: Told | undefined) => {
  const points = told ? list(told.points) : [];
  if (points.length === 0) return {};
  return { outline: points.map((point) => [point.radius_mm, point.height_mm] as [number, number]) };
};

// What the page's frame is, out of the fields that the engine names.
const MEANING: Record<string, (told: Told) => Frame> = {
  job: (told) => ({
    kind: "job",
    duration: told.duration_s as number,
    cell: told.cell_mm as number,
    blank: { min: told.blank_min_mm as never, max: told.blank_max_mm as never },
    cutters: list(told.cutters).map((cutter, n) => ({
      number: cutter.number as number,
      flutes: cutter.flutes as number,
      radius: cutter.radius_mm as number,
      corner: cutter.corner_radius_mm as number,
      length: cutter.length_mm as number,
      holder: list(cutter.holder).map((step) => ({
        radius: step.radius_mm as number,
        length: step.length_mm as number,
      })),
      ...outline(list(told.outlines)[n]),
    })),
    chipLimits: { rubbing: told.rubbing_chip_mm as number, overloadShare: told.overload_chip_share as number },
  }),
  chunk: (told) => ({
    kind: "chunk",
    chunk: [told.i, told.j, told.k] as never,
    ...mesh(told),
    deviations: floats(told.deviations_mm),
    onBlank: told.on_blank as number,
    rough: told.rough as boolean,
  }),
  designed: (told) => ({ kind: "designed", ...mesh(told) }),
  state: (told) => ({
    kind: "state",
    time: told.t_s as number,
    tip: told.tip_mm as never,
    axis: told.axis as never,
    force: told.force_n as never,
    peakForce: told.peak_force_n as number,
    torque: told.mean_torque_nm as number,
    rpm: told.spindle_rpm as number,
    feed: told.feed_mm_per_min as number,
    angle: told.spindle_angle_rad as number,
    removed: told.removed_mm3 as number,
    milled: told.milled_s as number,
    speed: told.speed as number,
    line: told.line as number,
    cutter: told.cutter as number,
    cutting: told.cutting as boolean,
    playing: told.playing as boolean,
    rapid: told.rapid as boolean,
    chatter: chatter(told.chatter as Told | undefined),
  }),
  rows: (told) => ({
    kind: "rows",
    anew: told.anew as boolean,
    rows: list(told.rows).map((row, n) => ({
      time: row.t_s as number,
      duration: row.duration_s as number,
      tip: row.tip_mm as never,
      meanForce: row.mean_force_n as number,
      peakForce: row.peak_force_n as number,
      torque: row.mean_torque_nm as number,
      entry: row.entry_rad as number,
      exit: row.exit_rad as number,
      depth: row.axial_depth_mm as number,
      feedPerTooth: row.feed_per_tooth_mm as number,
      line: row.line as number,
      chip: list(told.of_rows)[n]!.chip_mm as number,
      chipVerdict: (["", "rubbing", "overload"] as const)[list(told.of_rows)[n]!.chip_verdict as number]!,
      multiplier: 0,
      rpm: list(told.tools_of_rows)[n]!.spindle_rpm as number,
      axis: list(told.tools_of_rows)[n]!.axis as never,
      cutter: list(told.tools_of_rows)[n]!.cutter as number,
      ...peaksOf(row.peak_force_n as number, told.bands_of_rows ? list(told.bands_of_rows)[n]! : told),
    })),
  }),
  collision: (told) => ({
    kind: "collision",
    time: told.t_s as number,
    what: ["rapid through stock", "shank in stock", "holder in stock"][told.kind as number]!,
    line: told.line as number,
    tip: told.tip_mm as never,
  }),
  sound: (told) => ({
    kind: "sound",
    pieces: list(told.pieces).map((piece) => ({
      time: piece.t_s as number,
      duration: piece.duration_s as number,
      tip: piece.tip_mm as never,
      angle: piece.spindle_angle_rad as number,
      radPerS: piece.spindle_rad_per_s as number,
      pace: piece.pace as number,
      chips: piece.chip_mm3_per_s as number,
      orderStep: piece.order_step as number,
      harmonics: new Float32Array(
        list(piece.harmonics).flatMap((of) => flat([of.along_feed_n, of.left_of_feed_n, of.to_shank_n])),
      ),
    })),
  }),
  finger: (told) => ({
    kind: "finger",
    hand: told.probe_mm as never,
    proxy: told.proxy_mm as never,
    force: told.force_n as never,
    slip: told.slip_mm_per_s as number,
    contact: told.contact as boolean,
    on: told.cutting_force as boolean,
    cutMode: told.cut_mode as boolean,
    stopped: told.stopped as boolean,
    present: told.hand as boolean,
  }),
  servo: (told) => ({
    kind: "servo",
    ticks: told.ticks as number,
    late: told.late as number,
    fault: ["", "", "", "", "a force was no number"][told.fault as number]!,
    rate: told.rate_hz as number,
    limit: told.force_limit_n as number,
    largest: told.largest_force_n as number,
    lateness: told.lateness_us as never,
    cpu: told.cpu_us as never,
  }),
  texture: (told) => ({
    kind: "texture",
    triangles: list(told.triangles).map((of) => ({
      corners: [of.a_mm, of.b_mm, of.c_mm] as never,
      force: of.force_n as never,
    })),
  }),
  listening: (told) => ({ kind: "listening", listener: told.listener_mm as never }),
  path: (told) => ({
    kind: "path",
    times: new Float32Array(list(told.points).map((point) => point.t_s as number)),
    points: new Float32Array(list(told.points).flatMap((point) => flat(point.tip_mm))),
    rapid: new Uint8Array(list(told.points).map((point) => Number(point.rapid))),
    lines: new Uint32Array(list(told.lines_of_points).map((point) => point.line as number)),
  }),
  program: (told) => ({ kind: "program", name: told.name as string, text: told.text as string }),
  bending: () => ({ kind: "bending" }),
  multipliers: (told) => ({
    kind: "multipliers",
    first: told.first as number,
    multipliers: new Float32Array(list(told.rows).map((row) => row.multiplier as number)),
  }),
  chart: (told) => ({
    kind: "chart",
    fromRpm: told.from_rpm as number,
    stepRpm: told.step_rpm as number,
    stepMm: told.step_mm as number,
    depths: told.depths as number,
    limits: floats(told.limits_mm),
    multipliers: floats(told.multipliers),
    pockets: list(told.pockets).map((pocket) => ({
      rpm: pocket.spindle_rpm as number,
      depth: pocket.depth_mm as number,
    })),
  }),
};

function peaksOf(force: number, { force_low_factor: low, force_high_factor: high }: Told) {
  return { peakLow: force * (low as number), peakHigh: force * (high as number) };
}

const names = readdirSync(FOLDER)
  .filter((file) => file.endsWith(".bin"))
  .map((file) => file.slice(0, -4));

describe("what the engine has stored", () => {
  it("has every kind of frame that a page reads", () => {
    const kinds = new Set(names.map((name) => decoded(name).kind));
    expect(kinds).toEqual(new Set(Object.keys(MEANING)));
  });

  it.each(names)("%s means the same to the page", (name) => {
    const told = JSON.parse(readFileSync(join(FOLDER, `${name}.json`), "utf8")) as Told;
    const frame = decoded(name);
    expect(frame).toEqual(MEANING[frame.kind]!(told));
  });
});

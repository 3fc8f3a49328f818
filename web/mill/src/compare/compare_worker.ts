// SPDX-License-Identifier: MIT
// Mills two runs beside the page, one after the other, and each once more against the part of the other.

import type { MillExports, MillSoundExports } from "@tribo/wasm/exports";
import { joinedOf, type Joined } from "@tribo/wasm/joined";
import { doublesAt, textAt } from "@tribo/wasm/memory";
import { compile, instantiate } from "@tribo/wasm/module";
import { stl } from "../keep/stl.js";
import { RATE, type Clip } from "../learn/clip.js";
import { cellOf, heardOf, piecesAgainst, runOf, trianglesOf, type Run, type Side } from "./run.js";
import { extremesOf, packed, rangeOf, surfaceOf, type Extremes } from "./surface.js";

export interface ToCompare {
  a: Side;
  b: Side;
}
/** The run without what only its part and the joined rows are made of. */
export interface Told extends Omit<Run, "pieces" | "rows"> {
  seen: ReturnType<typeof packed>;
  clip: Clip;
  heard_from_s: number;
}
export interface Compared {
  version: string;
  a: Told;
  b: Told;
  joined: Joined;
  extremes: Extremes;
  /** Material that only one of the parts has, mm3. */
  only: { a: number; b: number };
}
export type FromCompare = { share: number } | { why: string } | { compared: Compared };

const mill = compile<MillExports>("tribo.wasm", self.location.href);
const ear = compile<MillSoundExports>("mill_sound.wasm", self.location.href);

function post(message: FromCompare): void {
  (self as unknown as { postMessage(m: FromCompare): void }).postMessage(message);
}

// New ones each time: their memory never shrinks.
const freshMill = async () => instantiate(await mill);
async function freshEar(): Promise<MillSoundExports> {
  const fresh = await instantiate(await ear);
  fresh.sound_open(RATE);
  return fresh;
}

// With the beginning of its cut for the ear.
async function run(side: Side, cell: number, progress: (share: number) => void) {
  const { pieces, rows, ...of } = runOf(await freshMill(), side, cell, progress);
  const heard_from_s = rows[0]?.time ?? 0;
  const clip = heardOf(await freshMill(), await freshEar(), side, cell, heard_from_s);
  return { pieces, of: { ...of, clip, heard_from_s } };
}

async function compare(sides: ToCompare): Promise<Compared> {
  let done = 0;
  const progress = (share: number) => post({ share: (done + share) / 4 });
  // One grid for both, the finer one, so that a difference is one of the runs.
  const first = await freshMill();
  const version = textAt(first, first.tribo_version());
  const cell = Math.min(cellOf(first, sides.a), cellOf(await freshMill(), sides.b));
  const a = await run(sides.a, cell, progress);
  done = 1;
  const b = await run(sides.b, cell, progress);
  done = 2;
  // Both in one module, which then has the material of both.
  const both = await freshMill();
  const againstB = piecesAgainst(both, sides.a, cell, stl(trianglesOf(b.pieces)), progress);
  both.mill_keep();
  done = 3;
  const againstA = piecesAgainst(both, sides.b, cell, stl(trianglesOf(a.pieces)), progress);
  const joined = joinedOf(both);
  const [onlyA, onlyB] = doublesAt(both, both.mill_volumes(), 2);
  const surfaces = [surfaceOf(againstB, -1), surfaceOf(againstA, 1)] as const;
  const range = rangeOf(surfaces);
  return {
    version,
    a: { ...a.of, seen: packed(surfaces[0], range) },
    b: { ...b.of, seen: packed(surfaces[1], range) },
    joined,
    extremes: extremesOf(surfaces),
    only: { a: onlyA!, b: onlyB! },
  };
}

self.onmessage = ({ data }: MessageEvent<ToCompare>) => {
  compare(data).then(
    (compared) => post({ compared }),
    (error: unknown) => post({ why: error instanceof Error ? error.message : String(error) }),
  );
};

// SPDX-License-Identifier: MIT
// A run of a job from its first to its last cut, for a comparison: rows, part, audit and the beginning of its sound.

import type { AuditOfMill } from "@tribo/wasm/audit";
import { auditOf } from "@tribo/wasm/audit";
import type { MillExports, MillSoundExports } from "@tribo/wasm/exports";
import { textAt } from "@tribo/wasm/memory";
import { openMill, putFile, tickMill } from "@tribo/wasm/mill";
import { obey } from "@tribo/wasm/mill_command";
import { decodeFrame, type ChunkFrame, type JobFrame, type Row } from "@tribo/protocol/frames";
import type { Change } from "../keep/moment.js";
import type { Triangles } from "../keep/triangles.js";
import { clipOf, type Clip } from "../learn/clip.js";
import { History } from "../panels/history.js";

/** What is heard of a run. */
export const HEARD_S = 10;
// So many checks of the time between two reports of the progress.
const LOOKS = 2000;
const END_S = 1e9;
// The clock of the mill is that of the program up to rounding.
const MILLED_S = 1e-3;

/** What is milled. */
export interface Side {
  files: { name: string; bytes: Uint8Array }[];
  job: string;
  part: string;
  changes: Change[];
}

export interface Run {
  job: JobFrame;
  /** Of the path: equal ones are the same moves. */
  path: string;
  material: string;
  warnings: string[];
  rows: Row[];
  audit: AuditOfMill;
  pieces: ChunkFrame[];
}

export const trianglesOf = (pieces: readonly ChunkFrame[]): Triangles[] =>
  pieces.map(({ positions, indices, onBlank = 0 }) => ({
    positions,
    indices,
    onBlank: Uint8Array.from({ length: positions.length / 3 }, (_, n) => Number(n < onBlank)),
  }));

function open(mill: MillExports, side: Side, cell: number): string[] {
  for (const { name, bytes } of side.files) putFile(mill, name, bytes);
  const good = openMill(mill, side.job, side.part, cell);
  const said = textAt(mill, mill.mill_text());
  if (!good) throw new Error(said);
  for (const change of side.changes) {
    const obeyed = obey(
      mill,
      change.key === "material"
        ? { op: "material", value: change.value }
        : { op: "set", key: change.key, value: change.value },
    );
    if (!obeyed) throw new Error(textAt(mill, mill.mill_text()));
  }
  return said.split("\n").filter(Boolean);
}

/** The spacing of the grid that a side has by itself, mm. Takes a fresh module. */
export function cellOf(mill: MillExports, side: Side): number {
  open(mill, side, 0);
  for (const bytes of tickMill(mill, 0, 1)) {
    const frame = decodeFrame(bytes);
    if (frame.kind === "job") return frame.cell;
  }
  throw new Error("the mill did not say its grid");
}

interface Milled {
  job: JobFrame;
  path: string;
  rows: Row[];
  pieces: ChunkFrame[];
}

// To the end of the program, until the part is exact.
function toTheEnd(mill: MillExports, progress: (share: number) => void): Milled {
  const history = new History();
  const chunks = new Map<string, ChunkFrame>();
  let job: JobFrame | undefined;
  let path = "";
  let milled = 0;
  obey(mill, { op: "seek", t_s: END_S });
  for (;;) {
    let news = false;
    for (const bytes of tickMill(mill, 0, LOOKS)) {
      const frame = decodeFrame(bytes);
      news ||= ["chunk", "rows", "multipliers"].includes(frame.kind);
      if (frame.kind === "job") job = frame;
      else if (frame.kind === "path") path += `${frame.points.join()};${frame.rapid.join()}`;
      else if (frame.kind === "chunk") chunks.set(frame.chunk.join(), frame);
      else if (frame.kind === "multipliers") history.addMultipliers(frame.first, frame.multipliers);
      else if (frame.kind === "state") ({ milled } = frame);
      else if (frame.kind === "rows") {
        if (frame.anew) history.forgetRows();
        history.addRows(frame.rows);
      }
    }
    if (!job) throw new Error("the mill did not begin");
    progress(Math.min(milled / job.duration, 1));
    const rough = [...chunks.values()].some((chunk) => chunk.rough);
    if (milled >= job.duration - MILLED_S && !rough && !news) {
      const pieces = [...chunks.values()].filter(({ indices }) => indices.length > 0);
      return { job, path, rows: history.rows, pieces };
    }
  }
}

/** Takes a fresh module. */
export function runOf(mill: MillExports, side: Side, cell: number, progress: (share: number) => void): Run {
  const warnings = open(mill, side, cell);
  const milled = toTheEnd(mill, progress);
  const { audit } = auditOf(mill);
  const { material } = JSON.parse(textAt(mill, mill.mill_settings())) as { material: string };
  return { ...milled, material, warnings, audit };
}

/** What is heard from a time of a side on. Takes fresh modules; the ear is open at RATE. */
export function heardOf(mill: MillExports, ear: MillSoundExports, side: Side, cell: number, from_s: number): Clip {
  open(mill, side, cell);
  return clipOf(mill, ear, { from_s, skip_s: 0, seconds: HEARD_S });
}

/** The pieces of a side once more, with their distances from another part, an STL file. Takes a fresh module, or one whose mill is kept. */
export function piecesAgainst(
  mill: MillExports,
  side: Side,
  cell: number,
  other: ArrayBuffer,
  progress: (share: number) => void,
): ChunkFrame[] {
  const name = "the other part.stl";
  const files = [...side.files, { name, bytes: new Uint8Array(other) }];
  open(mill, { ...side, files, part: name }, cell);
  return toTheEnd(mill, progress).pieces;
}

// SPDX-License-Identifier: MIT
// The rows of two runs, joined, as `tribo compare` joins them (src/session/compare/compared_rows.hpp): by line where both
// cut in the same lines, else by time. The rows of a page do not say what they remove.

import type { Cutter, Row } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";
import { word } from "../texts/texts.js";

interface Quantity {
  name: string;
  unit: string;
  // "most": the largest of a stretch; "mean": over its time; "sum".
  how: "most" | "mean" | "sum";
  of: (row: Row, cutter: Cutter | undefined) => number;
}
export const QUANTITIES: Quantity[] = [
  { name: word("peak force across the axis"), unit: "N", how: "most", of: (r) => r.peakForce },
  { name: word("mean force"), unit: "N", how: "mean", of: (r) => r.meanForce },
  { name: word("peak torque"), unit: "N m", how: "most", of: (r) => Math.abs(r.torque) },
  { name: word("depth of cut"), unit: "mm", how: "most", of: (r) => r.depth },
  { name: word("thickest chip"), unit: "mm", how: "most", of: (r) => r.chip },
  { name: word("feed"), unit: "mm/min", how: "mean", of: (r, c) => r.feedPerTooth * r.rpm * (c?.flutes ?? 0) },
  { name: word("spindle speed"), unit: word("rpm"), how: "mean", of: (r) => r.rpm },
  { name: word("chatter, |mu|"), unit: "", how: "most", of: (r) => r.multiplier },
  { name: word("cutting time"), unit: "s", how: "sum", of: (r) => r.duration },
];
const FORCE = 0;
const STEPS = 1000;

export interface Stretch {
  from_s: number;
  to_s: number;
  /** Of the row with the largest force. */
  line: number;
  tip: Vec3;
  /** In the order of QUANTITIES. */
  values: number[];
}
export interface Pair {
  /** Start and width on the common axis: time of A, or of both, s. */
  at: number;
  width: number;
  a: Stretch | undefined;
  b: Stretch | undefined;
}
export interface Joined {
  by: "line" | "time";
  /** Width of a step, s; 0: by line. */
  step_s: number;
  pairs: Pair[];
}

export interface Cuts {
  rows: readonly Row[];
  cutters: readonly Cutter[];
}

// Of rows, or of shares of rows, in the order of time.
function gathered(rows: readonly { row: Row; share: number }[], cutters: readonly Cutter[]): Stretch {
  const [first] = rows;
  const { row } = rows.reduce((most, next) => (next.row.peakForce > most.row.peakForce ? next : most), first!);
  const seconds = rows.reduce((sum, { row: r, share }) => sum + share * r.duration, 0);
  const values = QUANTITIES.map(({ how, of }) => {
    const value = (r: Row) => of(r, cutters[r.cutter]);
    if (how === "most") return rows.reduce((most, { row: r }) => Math.max(most, value(r)), 0);
    if (how === "sum") return rows.reduce((sum, { row: r, share }) => sum + share * value(r), 0);
    return rows.reduce((sum, { row: r, share }) => sum + share * r.duration * value(r), 0) / (seconds || 1);
  });
  const last = rows.at(-1)!.row;
  return { from_s: first!.row.time, to_s: last.time + last.duration, line: row.line, tip: row.tip, values };
}

function byLine({ rows, cutters }: Cuts): Stretch[] {
  const stretches: Stretch[] = [];
  let together: { row: Row; share: number }[] = [];
  rows.forEach((row, n) => {
    together.push({ row, share: 1 });
    if (rows[n + 1]?.line === row.line) return;
    stretches.push(gathered(together, cutters));
    together = [];
  });
  return stretches;
}

// In steps of equal width; a row may be in several.
function inSteps({ rows, cutters }: Cuts, step_s: number): (Stretch | undefined)[] {
  const steps: { row: Row; share: number }[][] = Array.from({ length: STEPS }, () => []);
  for (const row of rows) {
    const end = row.time + row.duration;
    const stepAt = (time: number) => Math.min(Math.max(Math.floor(time / step_s), 0), STEPS - 1);
    for (let n = stepAt(row.time); n <= stepAt(end); ++n) {
      const low = Math.max(row.time, n * step_s);
      const high = n === stepAt(end) ? end : (n + 1) * step_s;
      const share = row.duration > 0 ? (high - low) / row.duration : 1;
      if (share > 0) steps[n]!.push({ row, share });
    }
  }
  return steps.map((step) => (step.length > 0 ? gathered(step, cutters) : undefined));
}

export function join(a: Cuts, b: Cuts): Joined {
  const [linesA, linesB] = [byLine(a), byLine(b)];
  if (linesA.length === linesB.length && linesA.every(({ line }, n) => line === linesB[n]!.line)) {
    const pairs = linesA.map((of, n) => ({ at: of.from_s, width: of.to_s - of.from_s, a: of, b: linesB[n] }));
    return { by: "line", step_s: 0, pairs };
  }
  const end = ({ rows }: Cuts) => (rows.length > 0 ? rows.at(-1)!.time + rows.at(-1)!.duration : 0);
  const step_s = Math.max(end(a), end(b)) / STEPS;
  const [stepsA, stepsB] = [inSteps(a, step_s), inSteps(b, step_s)];
  const pairs = stepsA.map((of, n) => ({ at: n * step_s, width: step_s, a: of, b: stepsB[n] }));
  return { by: "time", step_s, pairs: pairs.filter((pair) => pair.a ?? pair.b) };
}

/** Those whose peak force differs most, the largest difference first. */
export function largest({ pairs }: Joined, most: number): (Pair & { a: Stretch; b: Stretch })[] {
  const change = ({ a, b }: { a: Stretch; b: Stretch }) => Math.abs(b.values[FORCE]! - a.values[FORCE]!);
  return pairs
    .filter((pair): pair is Pair & { a: Stretch; b: Stretch } => pair.a !== undefined && pair.b !== undefined)
    .filter((pair) => change(pair) > 0)
    .sort((one, other) => change(other) - change(one))
    .slice(0, most);
}

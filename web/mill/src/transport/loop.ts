// SPDX-License-Identifier: MIT
// One cut again and again: from where the tool enters to where it leaves.

import { begunAt } from "../rows.js";

// A tool that is out of the material for less is still in the cut, s of the program.
const GAP_S = 0.05;
/** Longer cuts are left so long after the tool entered, s of the program. */
export const LONGEST_S = 30;

interface Stretch {
  time: number;
  duration: number;
}

/** Whether the tool is in the cut at `time`; `rows` are in the order of time. */
export function isCut(rows: readonly Stretch[], time: number): boolean {
  const begun = begunAt(rows, time + GAP_S);
  const row = rows[begun - 1];
  return row !== undefined && time <= row.time + row.duration + GAP_S;
}

/** Where the cut begins that is made at `time`. */
export function entryOf(rows: readonly Stretch[], time: number): number {
  let entry = time;
  for (let n = begunAt(rows, time + GAP_S) - 1; n >= 0 && entry > time - LONGEST_S; --n) {
    const row = rows[n]!;
    if (row.time + row.duration < entry - GAP_S) break;
    entry = row.time;
  }
  return entry;
}

export class Loop {
  private from: number | undefined;
  // The clock was asked to go back from there, and has not yet.
  private asked: number | undefined;

  /** The rows so far. */
  constructor(private readonly rows: () => readonly Stretch[]) {}

  /** The clock was set: the cut there is the one. */
  forget(): void {
    this.from = this.asked = undefined;
  }

  /** Where the clock goes back to; undefined: the cut goes on, or has not begun. */
  next(time: number, ended: boolean): number | undefined {
    if (this.asked !== undefined && time >= this.asked) return undefined;
    this.asked = undefined;
    const cuts = isCut(this.rows(), time);
    if (cuts) this.from ??= entryOf(this.rows(), time);
    if (this.from === undefined || (cuts && !ended && time - this.from <= LONGEST_S)) return undefined;
    this.asked = time;
    return this.from;
  }
}

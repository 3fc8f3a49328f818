// SPDX-License-Identifier: MIT
// Data of the plots: the rows, and the newest pieces of the cut.

import type { Piece, Row } from "@tribo/protocol/frames";
import { begunAt } from "../rows.js";

const KEPT_PIECES = 4096;
const MOST_POINTS = 2000;
// Times of rows are sums of rounded durations.
const SHORTEST_GAP_S = 1e-3;

// With many rows, shows the largest value in each of MOST_POINTS intervals. Where nothing is cut there is no line.
export function overTime(
  rows: readonly Row[],
  ...values: ((row: Row) => number)[]
): [number[], ...(number | null)[][]] {
  const step = Math.max(1, Math.ceil(rows.length / MOST_POINTS));
  const times: number[] = [];
  const curves = values.map((): (number | null)[] => []);
  for (let n = 0; n < rows.length; n += step) {
    const stretch = rows.slice(n, n + step);
    const before = rows[n - 1];
    const ended = before ? before.time + before.duration : Infinity;
    if (ended < stretch[0]!.time - SHORTEST_GAP_S) {
      times.push(ended);
      for (const curve of curves) curve.push(null);
    }
    times.push(stretch[0]!.time);
    curves.forEach((curve, k) => curve.push(stretch.reduce((most, row) => Math.max(most, values[k]!(row)), -Infinity)));
  }
  return [times, ...curves];
}

export class History {
  rows: Row[] = [];
  // The rows with the largest force and the largest multiplier.
  strongest: Row | undefined;
  wildest: Row | undefined;
  private pieces: Piece[] = [];
  // Rows have multipliers.
  bends = false;
  time = 0;
  duration = 1;

  begin(duration: number): void {
    this.forgetRows();
    this.pieces = [];
    this.bends = false;
    this.duration = duration;
  }
  addRows(rows: Row[]): void {
    for (const row of rows) {
      this.rows.push(row);
      if (!(row.peakForce <= (this.strongest?.peakForce ?? 0))) this.strongest = row;
    }
  }
  // All rows are sent again.
  forgetRows(): void {
    this.rows = [];
    this.strongest = this.wildest = undefined;
  }
  // The row that is cut at a time.
  rowAt(time: number): Row | undefined {
    const row = this.rows[begunAt(this.rows, time) - 1];
    return row && time <= row.time + row.duration ? row : undefined;
  }
  // Returns the rows from the `first` on.
  addMultipliers(first: number, multipliers: Float32Array): Row[] {
    const rows = this.rows.slice(first, first + multipliers.length);
    rows.forEach((row, n) => {
      row.multiplier = multipliers[n]!;
      if (row.multiplier > (this.wildest?.multiplier ?? 0)) this.wildest = row;
    });
    return rows;
  }
  addPieces(pieces: Piece[]): void {
    for (const piece of pieces) this.pieces.push(piece);
    if (this.pieces.length > 2 * KEPT_PIECES) this.pieces = this.pieces.slice(-KEPT_PIECES);
  }
  // The current piece of the cut, or the last one.
  piece(): Piece | undefined {
    for (let n = this.pieces.length - 1; n >= 0; --n) if (this.pieces[n]!.time <= this.time) return this.pieces[n];
    return undefined;
  }
}

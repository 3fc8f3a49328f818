// SPDX-License-Identifier: MIT
// Data of the plots: the rows, and the newest pieces of the cut.

import type { Piece, Row } from "@tribo/protocol/frames";

const KEPT_PIECES = 4096;

export class History {
  rows: Row[] = [];
  private pieces: Piece[] = [];
  // Rows have multipliers.
  bends = false;
  time = 0;
  duration = 1;

  begin(duration: number): void {
    this.rows = [];
    this.pieces = [];
    this.bends = false;
    this.duration = duration;
  }
  addRows(rows: Row[]): void {
    for (const row of rows) this.rows.push(row);
  }
  // Returns the rows from the `first` on.
  addMultipliers(first: number, multipliers: Float32Array): Row[] {
    const rows = this.rows.slice(first, first + multipliers.length);
    rows.forEach((row, n) => (row.multiplier = multipliers[n]!));
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

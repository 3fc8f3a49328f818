// SPDX-License-Identifier: MIT
// How loud a piece of the cut is: the level of the force that changes with the turn of the spindle.

import type { Piece } from "@tribo/protocol/frames";

// The softest level of the lane, N: quieter pieces have none.
const SOFTEST_N = 0.1;

/** In dB over a force of 0.1 N, effective value across the axis; 0 and less: softer. */
export function level(piece: Piece): number {
  const h = piece.harmonics;
  let power = 0;
  for (let n = 6; n + 6 <= h.length; n += 6) {
    for (let k = 0; k < 4; ++k) power += 2 * h[n + k]! ** 2;
  }
  return power > 0 ? 10 * Math.log10(power / SOFTEST_N ** 2) : 0;
}

// SPDX-License-Identifier: MIT
// The rows of a cut, in the order of time.

import type { Row } from "@tribo/protocol/frames";

/** How many of them begin up to a time. */
export function begunAt(rows: readonly Pick<Row, "time">[], time: number): number {
  let [low, high] = [0, rows.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rows[middle]!.time <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

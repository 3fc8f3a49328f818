// SPDX-License-Identifier: MIT
// The rows of two mills, joined by the module as `tribo compare` joins them (src/session/compare/compared_rows.hpp).

import type { MillExports } from "./exports.js";
import { doublesAt, textAt } from "./memory.js";

export interface Quantity {
  name: string;
  unit: string;
}
export interface Stretch {
  from_s: number;
  to_s: number;
  /** Of the row with the largest force. */
  line: number;
  /** Likewise, mm. */
  tip: [number, number, number];
  /** In the order of `quantities`; NaN: not known. */
  values: number[];
}
export interface Pair {
  /** Number of the line, or start of the step: removed mm3, s. */
  place: number;
  /** Undefined: nothing is cut there. */
  a: Stretch | undefined;
  b: Stretch | undefined;
}
export interface Joined {
  by: "line" | "removed volume" | "time";
  /** Width of a step, mm3 or s; 0: by line. */
  step: number;
  quantities: Quantity[];
  pairs: Pair[];
}

// What stands before the quantities of a stretch.
const PLACED = 6;

/** Of the mill that is kept, A, and the open one, B. */
export function joinedOf(mill: MillExports): Joined {
  const quantities = textAt(mill, mill.mill_quantities())
    .split("\n")
    .map((line) => line.split("\t"))
    .map(([name, unit]) => ({ name: name!, unit: unit! }));
  const count = mill.mill_join();
  const [by, step] = textAt(mill, mill.mill_text()).split("\t");
  const length = PLACED + quantities.length;
  const width = 1 + 2 * length;
  const numbers = doublesAt(mill, mill.mill_joined(), count * width);
  const stretch = (at: number): Stretch | undefined => {
    const [from_s, to_s, line, x, y, z, ...values] = numbers.slice(at, at + length);
    return Number.isNaN(from_s) ? undefined : { from_s: from_s!, to_s: to_s!, line: line!, tip: [x!, y!, z!], values };
  };
  const pairs = Array.from({ length: count }, (_, n) => ({
    place: numbers[n * width]!,
    a: stretch(n * width + 1),
    b: stretch(n * width + 1 + length),
  }));
  return { by: by as Joined["by"], step: Number(step), quantities, pairs };
}

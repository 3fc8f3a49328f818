// SPDX-License-Identifier: MIT
// Colours of multipliers. Blue, yellow, vermilion and dark red are told apart by colour-blind eyes (after Okabe and
// Ito 2008), and by their lightness too.

import { word } from "../texts/texts.js";
import type { Vec3 } from "@tribo/protocol/vec3";

export interface Growth {
  // Multipliers up to this.
  most: number;
  words: string;
  colour: Vec3;
}

export const GROWTHS: Growth[] = [
  { most: 0.9, words: word("stable"), colour: [0, 0.45, 0.7] },
  { most: 1, words: word("near the limit (0.9 to 1)"), colour: [0.94, 0.89, 0.26] },
  { most: 1.3, words: word("chatters (above 1)"), colour: [0.84, 0.37, 0] },
  { most: Infinity, words: word("above 1.3"), colour: [0.42, 0.08, 0.05] },
];

// Undefined: the multiplier is not known.
export function growthColour(multiplier: number): Vec3 | undefined {
  return multiplier > 0 ? GROWTHS.find(({ most }) => multiplier <= most)!.colour : undefined;
}

// SPDX-License-Identifier: MIT
// Colours of the scene: two metals, those of the milling paper, and a set for colour-blind users (after Okabe and Ito
// 2008).

import { MACHINED, SAWN } from "@tribo/ui/studio";

export interface Palette {
  // Machined and untouched shine as metal.
  metal: boolean;
  machined: number;
  untouched: number;
  designed: number;
  cutter: number;
  finger: number;
  force: number;
}

export const PALETTES = {
  metal: {
    metal: true,
    machined: MACHINED.colour,
    untouched: SAWN.colour,
    designed: 0xf08ab4,
    cutter: 0xb4b7bc,
    finger: 0xd83a30,
    force: 0xd0342c,
  },
  paper: {
    metal: false,
    machined: 0x4f86c6,
    untouched: 0xa9adb4,
    designed: 0xf08ab4,
    cutter: 0xeab802,
    finger: 0xd83a30,
    force: 0xd0342c,
  },
  safe: {
    metal: false,
    machined: 0x0072b2,
    untouched: 0xb4b7bc,
    designed: 0xcc79a7,
    cutter: 0xf0e442,
    finger: 0xd55e00,
    force: 0xd55e00,
  },
} satisfies Record<string, Palette>;

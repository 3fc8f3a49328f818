// SPDX-License-Identifier: MIT
// The light on the bench, for all views of a part: a small studio of bright panels that metal reflects, and one sun. Also
// the two metals. z is up, as in the stock. src/report/picture/studio.cpp has the same panels for still pictures.

type Direction = readonly [number, number, number];

export interface Panel {
  towards: Direction;
  width: number;
  height: number;
  brightness: number;
}
const panel = (towards: Direction, width: number, height: number, brightness: number): Panel => ({
  towards,
  width,
  height,
  brightness,
});
/** Narrow ones with dark gaps make shallow grooves visible. */
export const PANELS = [
  panel([-0.75, 0.5, 0.9], 1.6, 0.9, 6),
  panel([0.15, 1, 0.95], 3, 0.28, 2.6),
  panel([0.1, 1, 0.42], 3.6, 0.3, 2.6),
  panel([0.95, 0.3, 0.6], 0.5, 2.2, 4),
  panel([-1, -0.4, 0.3], 0.6, 1.6, 3),
  panel([0.7, -1, 0.5], 0.8, 0.8, 3),
];
export const PANEL_DISTANCE = 3;

const FLOOR = 0.3;
const HORIZON = 0.62;
const ZENITH = 0.24;
/** Brightness of the room without its panels; `up` from -1, straight down, to 1. */
export function wallAt(up: number): number {
  return HORIZON + up * (up < 0 ? HORIZON - FLOOR : ZENITH - HORIZON);
}

/** Direction to the sun, not of unit length; its colour and strength. */
export const SUN = { towards: [-0.6, 0.45, 1] as const, colour: 0xfff8ee, strength: 1.9 };

/** From the front right, a little from above: where the studio shows a part best. */
export const USUAL_VIEW: Direction = [0.42, -0.95, 0.62];

/** Machined metal, untouched metal, and paint that shows a colour of data, which is no metal. */
export const MACHINED = { colour: 0xcfd2d5, roughness: 0.3, metalness: 1 };
export const SAWN = { colour: 0x85898f, roughness: 0.62, metalness: 0.4 };
export const PAINT = { roughness: 0.55, metalness: 0 };

/** How much lighter and darker a mark is. */
export const MARKS = 0.16;

// SPDX-License-Identifier: MIT
// The part of the window that the panels leave to the picture.

import { element } from "@tribo/ui/dom";
import type { Free } from "../sight/framing.js";

/** What lies over the lower end of the stage: the legend, and the sheets of a narrow window. */
export const OVER_STAGE = ["legend", "panel", "program"];
// At least this share of the stage is used, whatever lies over it.
const LEAST = 0.35;

export function freeOf(prelude: boolean): Free {
  const { x, y, width, height } = element("stage").getBoundingClientRect();
  // Before the film the panels are away, and its buttons lie below the part.
  if (prelude) return { x: 0, y, width: innerWidth, height: element("film-buttons").getBoundingClientRect().top - y };
  let end = y + height;
  for (const id of OVER_STAGE) {
    const over = element(id).getBoundingClientRect();
    const covers = over.height > 0 && over.left < x + width && over.right > x && over.top > y;
    if (covers) end = Math.min(end, over.top);
  }
  return { x, y, width, height: Math.max(end - y, LEAST * height) };
}

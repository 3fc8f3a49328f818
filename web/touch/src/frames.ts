// SPDX-License-Identifier: MIT
// One animation loop for all elements. It runs only while one of them moves.

import { clamp } from "@tribo/ui/clamp";

export interface Animated {
  /** Draws the frame at `now` (seconds). Returns false when nothing moves any more. */
  frame(now: number, seconds: number): boolean;
}

const running = new Map<Animated, number>();
let request = 0;
// Limit of the time step after a pause: the sheet is then at rest anyway.
const kLongestFrameS = 0.25;
const kLongestWaitMs = 200;

function tick(milliseconds: number): void {
  const now = milliseconds / 1000;
  // Elements added during the loop wait for the next frame.
  const before = [...running];
  for (const [element, last] of before) {
    if (!running.has(element)) continue;
    const seconds = last < 0 ? 1 / 60 : clamp(now - last, 0, kLongestFrameS);
    running.set(element, now);
    if (!element.frame(now, seconds)) running.delete(element);
  }
  request = running.size > 0 ? requestAnimationFrame(tick) : 0;
}

export function animate(element: Animated): void {
  if (!running.has(element)) running.set(element, -1);
  if (request === 0) request = requestAnimationFrame(tick);
}

export function stop(element: Animated): void {
  running.delete(element);
}

/** Runs after the next frame, when the page is idle or after a time limit. */
export function whenIdle(work: () => void): void {
  requestAnimationFrame(() =>
    setTimeout(() => {
      // Not every browser reports when it is idle.
      if (typeof requestIdleCallback === "function") requestIdleCallback(work, { timeout: kLongestWaitMs });
      else setTimeout(work, kLongestWaitMs);
    }),
  );
}

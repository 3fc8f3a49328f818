// SPDX-License-Identifier: MIT
// One animation loop for all elements; it runs only while one of them moves.

export interface Animated {
  /** Draws the frame at `now` (seconds); false: nothing moves any more. */
  frame(now: number, seconds: number): boolean;
}

const running = new Map<Animated, number>();
let request = 0;
// After a pause the sheet need not make up for all of it: it has long come to rest.
const kLongestFrameS = 0.25;
const kLongestWaitMs = 200;

function tick(milliseconds: number): void {
  const now = milliseconds / 1000;
  // One that is added meanwhile waits for the next frame.
  const before = [...running];
  for (const [element, last] of before) {
    if (!running.has(element)) continue;
    const seconds = last < 0 ? 1 / 60 : Math.min(kLongestFrameS, Math.max(0, now - last));
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

/** After the next frame, once the page is idle or has not been for a while. */
export function whenIdle(work: () => void): void {
  requestAnimationFrame(() =>
    setTimeout(() => {
      // Not every browser tells when it is idle.
      if (typeof requestIdleCallback === "function") requestIdleCallback(work, { timeout: kLongestWaitMs });
      else setTimeout(work, kLongestWaitMs);
    }),
  );
}

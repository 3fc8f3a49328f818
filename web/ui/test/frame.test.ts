// SPDX-License-Identifier: MIT

import { expect, it, vi } from "vitest";
import { oncePerFrame } from "../src/frame.js";

it("works once in a picture, however often it is asked, and again in the next one", () => {
  const waiting: (() => void)[] = [];
  vi.stubGlobal("requestAnimationFrame", (go: () => void) => waiting.push(go));
  let done = 0;
  const ask = oncePerFrame(() => {
    if (++done === 1) ask();
  });
  for (let n = 0; n < 5; ++n) ask();
  expect([waiting.length, done]).toEqual([1, 0]);
  waiting[0]!();
  // What is asked for while it works belongs to the next picture.
  expect([waiting.length, done]).toEqual([2, 1]);
  waiting[1]!();
  expect([waiting.length, done]).toEqual([2, 2]);
  vi.unstubAllGlobals();
});

// SPDX-License-Identifier: MIT
// Files into the mill of a page, and frames out of it.

import type { MillExports } from "./exports.js";
import { lend, lendText } from "./memory.js";

export function putFile(x: MillExports, name: string, content: string | Uint8Array): void {
  const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
  lendText(x, name, (...called) => lend(x, bytes, (...at) => x.mill_put_file(...called, ...at)));
}

/**
 * Opens a job or a program of the files. `cell` 0: the spacing of the job. mill_text() has the warnings, or the reason of
 * a refusal.
 */
export function openMill(x: MillExports, job: string, part = "", cell = 0): boolean {
  return lendText(x, job, (...name) => lendText(x, part, (...model) => x.mill_open(...name, ...model, cell))) === 1;
}

/** As many checks of the time budget in a tick as the milling takes. */
export const AS_MANY_AS_NEEDED = 0xffffffff;

/** Lets time pass, and returns copies of the frames. `looks`: see src/wasm/mill.cpp. */
export function tickMill(x: MillExports, seconds: number, looks = AS_MANY_AS_NEEDED): ArrayBuffer[] {
  const length = x.mill_tick(seconds, looks);
  const at = x.mill_frames();
  const view = new DataView(x.memory.buffer, at, length);
  const frames: ArrayBuffer[] = [];
  // Each: u32 length, u32 0, its bytes, zeros to a multiple of 8.
  for (let n = 0; n < length;) {
    const bytes = view.getUint32(n, true);
    frames.push(x.memory.buffer.slice(at + n + 8, at + n + 8 + bytes));
    n += 8 + 8 * Math.ceil(bytes / 8);
  }
  return frames;
}

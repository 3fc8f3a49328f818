// SPDX-License-Identifier: MIT
// Mills cuts and listens to them, one after the other, beside the page.

import type { MillExports, MillSoundExports } from "@tribo/wasm/exports";
import { compile, instantiate } from "@tribo/wasm/module";
import { clipOf, openFiles, RATE, type Clip, type Span } from "./clip.js";
import { hear, powersOf, type Heard } from "./measure.js";

export interface ToMill {
  files: Record<string, string>;
  job: string;
  span: Span;
  spindleHz: number;
  flutes: number;
}
export interface Listened {
  clip: Clip;
  heard: Heard;
  powers: Float64Array;
}
/** In the order of the questions. */
export type FromMill = Listened | { why: string };

const mill = compile<MillExports>("tribo.wasm", self.location.href);
const ear = compile<MillSoundExports>("mill_sound.wasm", self.location.href);

async function listen({ files, job, span, spindleHz, flutes }: ToMill): Promise<Listened> {
  // New ones each time: their memory never shrinks.
  const sound = await instantiate(await ear);
  sound.sound_open(RATE);
  const miller = await instantiate(await mill);
  openFiles(miller, files, job);
  const clip = clipOf(miller, sound, span);
  return { clip, heard: hear(clip[0], RATE, spindleHz, flutes), powers: powersOf(clip[0]) };
}

let last: Promise<unknown> = Promise.resolve();
self.onmessage = ({ data }: MessageEvent<ToMill>) => {
  last = last
    .then(() => listen(data))
    .catch((error: unknown): FromMill => ({ why: String(error) }))
    .then((message) => (self as unknown as { postMessage(m: FromMill): void }).postMessage(message));
};

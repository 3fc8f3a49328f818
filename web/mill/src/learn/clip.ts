// SPDX-License-Identifier: MIT
// The sound of a cut as samples: milled by tribo.wasm, heard by mill_sound.wasm, as the page does both while it plays.

import { decodeFrame } from "@tribo/protocol/frames";
import type { MillExports, MillSoundExports } from "@tribo/wasm/exports";
import { floatsAt, lend, textAt } from "@tribo/wasm/memory";
import { openMill, putFile, tickMill } from "@tribo/wasm/mill";
import { obey } from "@tribo/wasm/mill_command";

const PICTURES_PER_S = 60;

/** Of every clip, Hz. */
export const RATE = 48000;

/** Left and right. */
export type Clip = [Float32Array<ArrayBuffer>, Float32Array<ArrayBuffer>];

export interface Span {
  from_s: number; // of the program
  skip_s: number; // until the sound has settled
  seconds: number;
}

/** Opens a job in a fresh module; `files` by name, with their text. */
export function openFiles(mill: MillExports, files: Record<string, string>, job: string): void {
  for (const [name, text] of Object.entries(files)) putFile(mill, name, text);
  if (!openMill(mill, job)) throw new Error(textAt(mill, mill.mill_text()));
}

/** A job is open in the mill, and the fresh ear at RATE. */
export function clipOf(mill: MillExports, ear: MillSoundExports, { from_s, skip_s, seconds }: Span): Clip {
  obey(mill, { op: "seek", t_s: from_s });
  obey(mill, { op: "play" });
  const skipped = Math.round(skip_s * RATE);
  const clip: Clip = [new Float32Array(seconds * RATE), new Float32Array(seconds * RATE)];
  const frames = RATE / PICTURES_PER_S;
  for (let done = -skipped; done < clip[0].length; done += frames) {
    for (const bytes of tickMill(mill, 1 / PICTURES_PER_S)) {
      const frame = decodeFrame(bytes);
      if (frame.kind === "state") ear.sound_follow(frame.time, frame.speed, Number(frame.playing), 0);
      else lend(ear, new Uint8Array(bytes), (at, length) => ear.sound_take(at, length));
    }
    const samples = floatsAt(ear, ear.sound_render(frames), 2 * frames);
    for (let n = 0; n < frames; ++n) {
      for (const side of [0, 1] as const) if (done + n >= 0) clip[side][done + n] = samples[2 * n + side]!;
    }
  }
  return clip;
}

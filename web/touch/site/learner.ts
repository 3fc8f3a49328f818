// SPDX-License-Identifier: MIT
// A worker that learns: learn.wasm is loaded for the first recordings that come, and the page stays free
// meanwhile.
import { wordsOf } from "@tribo/ui/dom";
import type { LearnExports } from "@tribo/wasm/exports";
import { doublesAt, lendText, textAt } from "@tribo/wasm/memory";
import { compile, instantiate, type Compiled } from "@tribo/wasm/module";
import type { Texture, VoiceModel } from "../src/material.js";
import type { Sound } from "./sound.js";

export interface Lesson {
  name: string;
  speed: number;
  force: number;
  sound: Sound;
}
export interface Source {
  file: string;
  seconds: number;
  sample_rate_hz: number;
  channels: number;
  bits?: number;
  peak_db: number;
  silent_share: number;
  clipped_share: number;
}
/** A voice as a material file has it. */
export type LearnedVoice = Omit<VoiceModel, "texture"> & { texture?: Texture; bass?: Bass; recordings: Source[] };
/** Below 700 Hz, in more detail than the voice's own model; for the chips of a cut. */
export interface Bass {
  share: number;
  sample_rate_hz: number;
  reflection: number[];
}
export interface Learned {
  level_law: { level_db: number; db_per_decade_speed: number; db_per_decade_force: number };
  voices: LearnedVoice[];
  warnings: string;
}
export type Answer = { learned: Learned } | { wrong: string };

export const kHighpassHz = 50;

function texture(take: () => number, list: (n: number) => number[], bands: number): Texture {
  const crossovers_hz = list(bands - 1);
  const levels_db = Array.from({ length: bands }, () => list(17));
  const coherence = take();
  const lengths = take();
  const lengths_mm = list(lengths);
  const weights = list(lengths);
  const [per_mm, share, scatter] = list(3) as [number, number, number];
  return {
    crossovers_hz,
    levels_db,
    coherence,
    lengths_mm,
    weights,
    grains: { per_mm, share, scatter, sizes: list(take()), shape: list(take()) },
  };
}

/** The numbers of voice_create (src/wasm/touch_voice.cpp), and the bass of each voice, as parts of a material file. */
function voicesOf(numbers: Float64Array): Omit<Learned, "warnings"> {
  let at = 0;
  const take = () => numbers[at++]!;
  const list = (n: number) => Array.from(numbers.subarray(at, (at += n)));
  const count = take();
  const [level_db, db_per_decade_speed, db_per_decade_force] = list(3) as [number, number, number];
  const voices = Array.from({ length: count }, (): LearnedVoice => {
    const [speed_mm_per_s, force_n, level, sample_rate_hz] = list(4) as [number, number, number, number];
    const reflection = list(take());
    const bands = take();
    return {
      speed_mm_per_s,
      force_n,
      level_db: level,
      sample_rate_hz,
      reflection,
      ...(bands > 0 ? { texture: texture(take, list, bands) } : {}),
      recordings: [],
    };
  });
  for (const voice of voices) {
    const order = take();
    if (order > 0) voice.bass = { share: take(), sample_rate_hz: take(), reflection: list(order) };
  }
  return { level_law: { level_db, db_per_decade_speed, db_per_decade_force }, voices };
}

const rounded = (value: number, step: number) => Math.round(value / step) / Math.round(1 / step);

export function learn(x: LearnExports, lessons: Lesson[]): Answer {
  const learning = x.learn_create();
  for (const { name, speed, force, sound } of lessons) {
    const { length } = sound.samples;
    const samples = lendText(x, name, (at, bytes) =>
      x.learn_add(learning, at, bytes, length, sound.rate, speed, force),
    );
    doublesAt(x, samples, length).set(sound.samples);
  }
  const good = x.learn_run(learning, kHighpassHz) !== 0;
  const words = textAt(x, x.learn_text(learning));
  if (!good) return { wrong: words };
  const learned = {
    ...voicesOf(doublesAt(x, x.learn_numbers(learning), x.learn_number_count(learning))),
    warnings: words,
  };
  const found = doublesAt(x, x.learn_found(learning), 5 * lessons.length);
  lessons.forEach(({ name, sound }, i) => {
    const [model, seconds, peak, silent, clipped] = found.subarray(5 * i) as unknown as number[];
    learned.voices[model!]!.recordings.push({
      file: name,
      seconds: rounded(seconds!, 1e-3),
      sample_rate_hz: sound.rate,
      channels: sound.channels,
      ...(sound.bits > 0 ? { bits: sound.bits } : {}),
      peak_db: rounded(peak!, 0.01),
      silent_share: rounded(silent!, 1e-4),
      clipped_share: clipped!,
    });
  });
  x.learn_destroy(learning);
  return { learned };
}

let module: Promise<Compiled<LearnExports>> | undefined;

async function answer(lessons: Lesson[]): Promise<Answer> {
  module ??= compile<LearnExports>("learn.wasm", import.meta.url);
  // A new instance each time: the memory of long recordings goes with it.
  return learn(await instantiate(await module), lessons);
}

self.onmessage = (event: MessageEvent<Lesson[]>) => {
  answer(event.data).then(
    (said) => self.postMessage(said),
    (error: unknown) => {
      module = undefined;
      const trap = error instanceof WebAssembly.RuntimeError;
      self.postMessage({
        wrong: trap ? "there is not enough memory to learn from all of this; give shorter recordings" : wordsOf(error),
      });
    },
  );
};

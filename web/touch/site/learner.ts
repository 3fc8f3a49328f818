// SPDX-License-Identifier: MIT
// A worker for learning. It loads learn.wasm for the first recordings, so that the page stays responsive.
import { wordsOf } from "@tribo/ui/dom";
import type { LearnExports } from "@tribo/wasm/exports";
import { doublesAt, lendText, textAt } from "@tribo/wasm/memory";
import { compile, instantiate, type Compiled } from "@tribo/wasm/module";
import type { Material } from "../src/material.js";
import type { Sound } from "./sound.js";

export interface Lesson {
  name: string;
  speed: number;
  force: number;
  sound: Sound;
}
/** A material file as written by `tribo learn`, without a name and a picture. */
export type Learned = Pick<
  Material,
  "schema" | "stiffness_n_per_mm" | "viscosity_n_s_per_mm" | "method" | "highpass_hz" | "level_law" | "voices"
>;
export type Answer = { learned: Learned; warnings: string } | { wrong: string };

export function learn(x: LearnExports, lessons: Lesson[]): Answer {
  const learning = x.learn_create();
  for (const { name, speed, force, sound } of lessons) {
    const { samples, rate, channels, bits } = sound;
    const at = lendText(x, name, (text, bytes) =>
      x.learn_add(learning, text, bytes, samples.length, rate, speed, force, channels, bits),
    );
    doublesAt(x, at, samples.length).set(samples);
  }
  const good = x.learn_run(learning) !== 0;
  const text = textAt(x, x.learn_text(learning));
  const said: Answer = good
    ? { learned: JSON.parse(text) as Learned, warnings: textAt(x, x.learn_warnings(learning)) }
    : { wrong: text };
  x.learn_destroy(learning);
  return said;
}

let module: Promise<Compiled<LearnExports>> | undefined;

async function answer(lessons: Lesson[]): Promise<Answer> {
  module ??= compile<LearnExports>("learn.wasm", import.meta.url);
  // A new instance each time, so that the memory of long recordings is freed.
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

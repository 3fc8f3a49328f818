// SPDX-License-Identifier: MIT
// learn.wasm in Node.js: what is wrong in words, an all-pole model of order 2 found again, twice the same text.
import { expect, test } from "vitest";
import type { LearnExports } from "../src/exports.js";
import { doublesAt, lendText, textAt } from "../src/memory.js";
import { load } from "./load.js";

interface Recording {
  samples: Float64Array;
  rate: number;
  speed: number;
}

/** What is looked at of a material file. */
interface Made {
  voices: { reflection: number[]; recordings: object[] }[];
}

async function learn(recordings: Recording[]): Promise<{ good: boolean; text: string }> {
  const x = await load<LearnExports>("learn");
  const learning = x.learn_create();
  for (const { samples, rate, speed } of recordings) {
    const at = lendText(x, "rub", (name, bytes) =>
      x.learn_add(learning, name, bytes, samples.length, rate, speed, 1, 2, 16),
    );
    doublesAt(x, at, samples.length).set(samples);
  }
  const good = x.learn_run(learning) !== 0;
  return { good, text: textAt(x, x.learn_text(learning)) };
}

/** Noise through x[n] = e[n] - a1 x[n-1] - a2 x[n-2]. */
function noise(length: number, a1: number, a2: number, level: number): Float64Array {
  let state = 1;
  let x1 = 0;
  let x2 = 0;
  const uniform = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32 - 0.5;
  return Float64Array.from({ length }, () => {
    const x = (uniform() + uniform() + uniform() + uniform()) * level - a1 * x1 - a2 * x2;
    [x2, x1] = [x1, x];
    return x;
  });
}

test("a model that sound was made with is found again, and twice the same", async () => {
  const recording = [{ samples: noise(96000, -1.2, 0.5, 0.05), rate: 48000, speed: 100 }];
  const { good, text } = await learn(recording);
  expect(good).toBe(true);
  const made = JSON.parse(text) as Made;
  expect(made).toMatchObject({ schema: "tribo.material/1", method: "yule-walker", highpass_hz: 50 });
  const [voice] = made.voices;
  expect(made.voices.length).toBe(1);
  expect(voice).toMatchObject({ speed_mm_per_s: 100, force_n: 1, sample_rate_hz: 48000 });
  expect(voice?.recordings).toMatchObject([{ file: "rub", seconds: 2, channels: 2, bits: 16 }]);
  const [k1 = 0, k2 = 0] = voice!.reflection;
  expect(Math.abs(k1 + 0.8)).toBeLessThan(0.02);
  expect(Math.abs(k2 - 0.5)).toBeLessThan(0.03);
  expect((await learn(recording)).text).toBe(text);
});

test("what is wrong is said in words", async () => {
  const wrong = async (...recordings: Recording[]) => (await learn(recordings)).text;
  expect(await wrong()).toMatch(/no recording was given; give at least one/);
  expect(await wrong({ samples: new Float64Array(48000), rate: 48000, speed: 100 })).toMatch(/rub: error: is silent/);
  expect(await wrong({ samples: noise(48000, 0, 0, 0.1), rate: 48000, speed: 0 })).toMatch(
    /the speed of the finger of .* is out of range/,
  );
  const broken = noise(48000, 0, 0, 0.1);
  broken[100] = Number.NaN;
  expect(await wrong({ samples: broken, rate: 48000, speed: 100 })).toMatch(/no numbers/);
});

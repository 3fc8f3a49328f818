// SPDX-License-Identifier: MIT
// learn.wasm in Node: no imports, what is wrong in words, an all-pole model of order 2 found again, twice the same.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

const folder = process.env.TRIBO_WASM_DIR ?? new URL("../../build/wasm", import.meta.url).pathname;

async function learn(recordings) {
  const module = await WebAssembly.compile(await readFile(`${folder}/learn.wasm`));
  assert.deepEqual(WebAssembly.Module.imports(module), []);
  const { exports: x } = await WebAssembly.instantiate(module, {});
  x._initialize();
  const learning = x.learn_create(), name = x.tribo_allocate(3);
  new Uint8Array(x.memory.buffer, name, 3).set([114, 117, 98]);
  for (const { samples, rate, speed } of recordings) {
    const at = x.learn_add(learning, name, 3, samples.length, rate, speed, 1);
    new Float64Array(x.memory.buffer, at, samples.length).set(samples);
  }
  const good = x.learn_run(learning, 50);
  const text = Buffer.from(x.memory.buffer, x.learn_text(learning)), words = text.subarray(0, text.indexOf(0)).toString();
  return good ? { numbers: [...new Float64Array(x.memory.buffer, x.learn_numbers(learning), x.learn_number_count(learning))], words } : { words };
}

function noise(length, a1, a2, level) {
  let state = 1, x1 = 0, x2 = 0;
  const uniform = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32 - 0.5;
  return Float64Array.from({ length }, () => {
    const x = (uniform() + uniform() + uniform() + uniform()) * level - a1 * x1 - a2 * x2;
    [x2, x1] = [x1, x];
    return x;
  });
}

test("a model that sound was made with is found again, and twice the same", async () => {
  const recording = [{ samples: noise(96000, -1.2, 0.5, 0.05), rate: 48000, speed: 100 }];
  const { numbers } = await learn(recording);
  assert.deepEqual(numbers.slice(0, 1).concat(numbers.slice(4, 6)), [1, 100, 1]);
  const [k1, k2] = numbers.slice(9);
  assert.ok(Math.abs(k1 + 0.8) < 0.02 && Math.abs(k2 - 0.5) < 0.03, `${k1} ${k2}`);
  assert.deepEqual((await learn(recording)).numbers, numbers);
});

test("what is wrong is said in words", async () => {
  assert.match((await learn([])).words, /no recording was given; give at least one/);
  assert.match((await learn([{ samples: new Float64Array(48000), rate: 48000, speed: 100 }])).words, /rub: error: is silent/);
  assert.match((await learn([{ samples: noise(48000, 0, 0, 0.1), rate: 48000, speed: 0 }])).words, /speed or force that is not above 0/);
  const broken = noise(48000, 0, 0, 0.1);
  broken[100] = Number.NaN;
  assert.match((await learn([{ samples: broken, rate: 48000, speed: 100 }])).words, /no numbers/);
});

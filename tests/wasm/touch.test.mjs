// SPDX-License-Identifier: MIT
// touch.wasm in Node: no imports, a sheet that goes to force over stiffness and back to rest, a voice that plays.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

const folder = process.env.TRIBO_WASM_DIR ?? new URL("../../build/wasm", import.meta.url).pathname;

async function load() {
  const module = await WebAssembly.compile(await readFile(`${folder}/touch.wasm`));
  assert.deepEqual(WebAssembly.Module.imports(module), []);
  const { exports } = await WebAssembly.instantiate(module, {});
  exports._initialize();
  return exports;
}

test("a sheet goes to force over stiffness and back to exact rest", async () => {
  const x = await load();
  const sheet = x.sheet_create(101, 64, 1);
  x.sheet_set_material(sheet, 4, 0.3);
  const contacts = (...numbers) => new Float64Array(x.memory.buffer, x.sheet_contacts(sheet), 7).set(numbers);
  const node = (i, j) => new Float32Array(x.memory.buffer, x.sheet_heights(sheet) + 4 * (j * x.sheet_stride(sheet) + i), 1)[0];
  contacts(50.5, 30.5, 6, 6, 0, 2, 0);
  x.sheet_press(sheet, 1, 0, 0);
  while (x.sheet_step(sheet, 1 / 60, 0)) assert.ok(node(50, 30) <= 0);
  assert.ok(Math.abs(node(50, 30) + 0.5) < 1e-5, String(node(50, 30)));
  const [, , width, height] = new Int32Array(x.memory.buffer, x.sheet_changes(sheet), 4);
  assert.ok(width > 40 && height > 40);
  contacts(Number.NaN, 30, 6, 6, 0, 2, 0);
  x.sheet_press(sheet, 1, 0, 0);
  while (x.sheet_step(sheet, 1 / 60, 0));
  for (let j = 0; j < 64; ++j) for (let i = 0; i < 101; ++i) assert.equal(node(i, j), 0);
  x.sheet_destroy(sheet);
});

test("memory does not grow over a thousand sheets", async () => {
  const x = await load();
  const once = () => x.sheet_destroy(x.sheet_create(256, 256, 0.3));
  for (let i = 0; i < 10; ++i) once();
  const bytes = x.memory.buffer.byteLength;
  for (let i = 0; i < 1000; ++i) once();
  assert.equal(x.memory.buffer.byteLength, bytes);
});

test("a voice plays what it was told and is silent at rest; numbers that are no voice give none", async () => {
  const x = await load();
  const create = (numbers) => {
    const at = x.tribo_allocate(8 * numbers.length);
    new Float64Array(x.memory.buffer, at).set(numbers);
    const voice = x.voice_create(at, numbers.length, 48000, 1, 0);
    x.tribo_release(at);
    return voice;
  };
  const voice = create([1, -20, 10, 10, 100, 1, -20, 48000, 1, -0.5, 0]);
  const out = x.tribo_allocate(4 * 48000);
  const level = (speed, force) => {
    x.voice_set_target(voice, speed, force);
    x.voice_render(voice, out, 48000);
    x.voice_render(voice, out, 48000);
    const samples = new Float32Array(x.memory.buffer, out, 48000);
    return Math.sqrt(samples.reduce((sum, s) => sum + s * s, 0) / samples.length);
  };
  assert.ok(Math.abs(20 * Math.log10(level(100, 1)) + 20) < 0.5);
  assert.equal(level(0, 1), 0);
  for (const numbers of [[], [1], [1, 0, 0, 0, 100, 1, -20, 48000, 1], [1, 0, 0, 0, 100, 1, -20, 48000, 1, 2, 0], [1, 0, 0, 0, Number.NaN, 1, -20, 48000, 0, 0], [2, 0, 0, 0, 100, 1, -20, 48000, 0, 0, 50, 1, -20, 48000, 0, 0]]) {
    assert.equal(create(numbers), 0);
  }
});

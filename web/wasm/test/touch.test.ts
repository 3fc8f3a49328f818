// SPDX-License-Identifier: MIT
// touch.wasm in Node.js: a sheet that goes to force over stiffness and back to rest, a voice that plays.
import { expect, test } from "vitest";
import type { TouchExports } from "../src/exports.js";
import { doublesAt, floatsAt, lend, textAt } from "../src/memory.js";
import { load as loadModule } from "./load.js";

const load = () => loadModule<TouchExports>("touch");

test("a sheet goes to force over stiffness and back to exact rest", async () => {
  const x = await load();
  const sheet = x.sheet_create(101, 64, 1);
  x.sheet_set_material(sheet, 4, 0.3);
  const contacts = (...numbers: number[]) => doublesAt(x, x.sheet_contacts(sheet), 7).set(numbers);
  const node = (i: number, j: number) =>
    floatsAt(x, x.sheet_heights(sheet) + 4 * (j * x.sheet_stride(sheet) + i), 1)[0]!;
  contacts(50.5, 30.5, 6, 6, 0, 2, 0);
  x.sheet_press(sheet, 1, 0, 0);
  while (x.sheet_step(sheet, 1 / 60, 0)) expect(node(50, 30)).toBeLessThanOrEqual(0);
  expect(Math.abs(node(50, 30) + 0.5)).toBeLessThan(1e-5);
  const [, , width, height] = new Int32Array(x.memory.buffer, x.sheet_changes(sheet), 4);
  expect(width).toBeGreaterThan(40);
  expect(height).toBeGreaterThan(40);
  contacts(Number.NaN, 30, 6, 6, 0, 2, 0);
  x.sheet_press(sheet, 1, 0, 0);
  while (x.sheet_step(sheet, 1 / 60, 0));
  let highest = 0;
  for (let j = 0; j < 64; ++j) for (let i = 0; i < 101; ++i) highest = Math.max(highest, Math.abs(node(i, j)));
  expect(highest).toBe(0);
  x.sheet_destroy(sheet);
});

test("memory does not grow over a thousand sheets", async () => {
  const x = await load();
  const once = () => x.sheet_destroy(x.sheet_create(256, 256, 0.3));
  for (let i = 0; i < 10; ++i) once();
  const bytes = x.memory.buffer.byteLength;
  for (let i = 0; i < 1000; ++i) once();
  expect(x.memory.buffer.byteLength).toBe(bytes);
});

test("a voice plays what it was told and is silent at rest; numbers that are no voice give none", async () => {
  const x = await load();
  const create = (numbers: number[]) =>
    lend(x, new Float64Array(numbers), (at) => x.voice_create(at, numbers.length, 48000, 1, 0));
  const voice = create([1, -20, 10, 10, 1, 1, 100, 1, -20, 48000, 1, -0.5, 0]);
  const out = x.tribo_allocate(4 * 48000);
  const level = (speed: number, force: number) => {
    x.voice_set_target(voice, speed, force);
    x.voice_render(voice, out, 48000);
    x.voice_render(voice, out, 48000);
    const samples = floatsAt(x, out, 48000);
    return Math.sqrt(samples.reduce((sum, s) => sum + s * s, 0) / samples.length);
  };
  expect(Math.abs(20 * Math.log10(level(100, 1)) + 20)).toBeLessThan(0.5);
  expect(level(0, 1)).toBe(0);
  const refusals: [number[], string][] = [
    [[], "level_law is missing"],
    [[0, 0], "voices are none"],
    [[0, 1, 0], "voices has an entry that is no object"],
    [[0, 1, 1, 100, 1, -20, 48000, 1], "reflection is missing"],
    [[0, 1, 1, 100, 1, -20, 48000, 1, 2, 0], "reflection is out of range"],
    [[0, 1, 1, Number.NaN, 1, -20, 48000, 0, 0], "speed_mm_per_s is out of range"],
    [[0, 2, 1, 100, 1, -20, 48000, 0, 0, 1, 50, 1, -20, 48000, 0, 0], "speed_mm_per_s does not rise"],
    [[0, 1, 1, 100, 1, -20, 48000, 0, 0, 7], "voices are followed by more"],
  ];
  for (const [numbers, words] of refusals) {
    expect(create(numbers)).toBe(0);
    expect(textAt(x, x.voice_refusal())).toBe(words);
  }
});

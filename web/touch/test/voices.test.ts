// SPDX-License-Identifier: MIT
// Material files as the program reads them (tests/material): touch.wasm sounds the same sample for sample, the page
// and its module refuse the same.
import { readdirSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";
import type { TouchExports } from "@tribo/wasm/exports";
import { floatsAt, lend, textAt } from "@tribo/wasm/memory";
import { instantiateNow, type Compiled } from "@tribo/wasm/module";
import { beforeEach, expect, test } from "vitest";
import { MODULES, ROOT } from "../../tools/places.js";
import { parseMaterial, voiceNumbers, type Material } from "../src/material.js";
import { kFields, type Field, type Fields } from "../src/material_schema.js";

const kTests = join(ROOT, "tests/material");
const read = (path: string) => JSON.parse(readFileSync(path, "utf8")) as unknown;
const parse = (json: unknown) => parseMaterial(json, "https://example.org/m.json");
const files = [join(ROOT, "examples/materials"), join(kTests, "odd")].flatMap((folder) =>
  readdirSync(folder)
    .filter((name) => name.endsWith(".json"))
    .map((name) => join(folder, name)),
);
const hashes = new Map(
  readFileSync(join(kTests, "voices.txt"), "utf8")
    .trim()
    .split("\n")
    .map((line) => line.split(" ") as [string, string]),
);

const module: Compiled<TouchExports> = new WebAssembly.Module(readFileSync(join(MODULES, "touch.wasm")));
let x: TouchExports;
beforeEach(() => {
  x = instantiateNow(module);
});

const create = (material: Material, published = false) => {
  const numbers = voiceNumbers(material);
  return lend(x, numbers, (at) => x.voice_create(at, numbers.length, 48000, 7, Number(published)));
};

/** As src/base/hash.hpp. */
class Hash {
  value = 0xcbf29ce484222325n;
  add(bytes: Uint8Array): void {
    for (const byte of bytes) this.value = BigInt.asUintN(64, (this.value ^ BigInt(byte)) * 0x100000001b3n);
  }
}

/** As tests/material/voices_test.cpp. */
function addSound(hash: Hash, material: Material, published: boolean): void {
  const voice = create(material, published);
  expect(voice, textAt(x, x.voice_refusal())).not.toBe(0);
  const out = x.tribo_allocate(4 * 2400);
  const targets: [number, number][] = [[40, 0.3], [100, 1], [300, 2], [2000, 5], [0, 0], [5, 0.1]]; // prettier-ignore
  for (const target of targets) {
    x.voice_set_target(voice, ...target);
    x.voice_render(voice, out, 2400);
    hash.add(new Uint8Array(floatsAt(x, out, 2400).slice().buffer));
  }
}

test.each(files.map((path) => [basename(path, ".json"), path]))(
  "%s sounds as the program plays it, sample for sample",
  (name, path) => {
    const hash = new Hash();
    const material = parse(read(path));
    addSound(hash, material, false);
    addSound(hash, material, true);
    expect(hash.value.toString(16).padStart(16, "0")).toBe(hashes.get(name));
  },
);

test("the program knows no others", () => expect(hashes.size).toBe(files.length));

// What is refused ---------------------------------------------------------------------------------------------------

type Json = Record<string, unknown>;
const whole = () => read(join(kTests, "odd/whole.json")) as Json;

/** Puts a value where a JSON pointer says. */
function set(json: Json, pointer: string, value: unknown): Json {
  const keys = pointer.split("/").slice(1);
  const last = keys.pop()!;
  let at = json;
  for (const key of keys) at = at[key] as Json;
  at[last] = value;
  return json;
}

/** What page or module say of a file; "" where both take it. */
function refusal(json: unknown): string {
  let material: Material;
  try {
    material = parse(json);
  } catch (error) {
    return (error as Error).message;
  }
  return create(material) === 0 ? textAt(x, x.voice_refusal()) : "";
}

test("a file with every key is taken", () => expect(refusal(whole())).toBe(""));

const wrong = read(join(kTests, "refused.json")) as { at: string; value: unknown; says: string }[];
test.each(wrong)("$at = $value is refused as by the program", ({ at, value, says }) => {
  expect(refusal(set(whole(), at, value))).toContain(says);
});

interface Numeric {
  pointer: string;
  key: string;
  field: Field;
  heard: boolean;
}

function numbersOf(fields: Fields, path = "", heard = false): Numeric[] {
  return Object.entries(fields).flatMap(([key, field]) => {
    const pointer = `${path}/${key}`;
    const goes = !field.unheard && (heard || pointer === "/voices" || pointer === "/level_law");
    if (field.fields !== undefined)
      return numbersOf(field.fields, pointer + (field.most === undefined ? "" : "/0"), goes);
    if (field.to === undefined) return [];
    const inside = (field.most === undefined ? "" : "/0") + (field.longest === undefined ? "" : "/0");
    return [{ pointer: pointer + inside, key, field, heard: goes }];
  });
}

/** The next double above; below for `up` -1. */
function next(value: number, up: 1 | -1): number {
  if (value === 0) return up * Number.MIN_VALUE;
  const bits = new BigInt64Array(new Float64Array([value]).buffer);
  bits[0]! += value > 0 === up > 0 ? 1n : -1n;
  return new Float64Array(bits.buffer)[0]!;
}

test.each(numbersOf(kFields))("$pointer is held to at both ends of its range", ({ pointer, key, field, heard }) => {
  const least = field.from ?? next(field.above!, 1);
  for (const end of [least, field.to!]) expect(refusal(set(whole(), pointer, end))).not.toContain("is not a number");
  for (const beyond of [next(least, -1), next(field.to!, 1)]) {
    const said = refusal(set(whole(), pointer, beyond));
    expect(said).toContain(key);
    expect(said).toContain(`to ${field.to}`);
    if (!heard) continue;
    // The module by itself.
    const material = parse(whole());
    set(material as unknown as Json, pointer, beyond);
    expect(create(material)).toBe(0);
    expect(textAt(x, x.voice_refusal())).toBe(`${key} is out of range`);
  }
});

// SPDX-License-Identifier: MIT
// Reads material files (docs/material.md) in the page. The valid contents are in material_schema.ts.
import { kFields, kSchema, type Field, type Fields, type Material } from "./material_schema.js";

export type { Material, Voice } from "./material_schema.js";

const kAssumedWidthMm = 100;

function fail(path: string, what: string): never {
  throw new Error(`material: ${path} ${what}`);
}

function readNumber(value: unknown, path: string, { from, above, to }: Field): number {
  if (typeof value !== "number" || !(value <= to! && (value >= from! || value > above!))) {
    fail(path, `is not a number ${from === undefined ? `above ${above}` : `from ${from}`} to ${to}`);
  }
  return value;
}

type Read<T> = (value: unknown, path: string) => T;

function readList<T>(value: unknown, path: string, most: number, read: Read<T>): T[] {
  if (!Array.isArray(value) || value.length > most) fail(path, `is not a list of up to ${most}`);
  return value.map((item, i) => read(item, `${path}[${i}]`));
}

function readObject(value: unknown, path: string, fields: Fields): Record<string, unknown> {
  if (typeof value !== "object" || value === null || Array.isArray(value)) fail(path || "file", "is not an object");
  const at = (key: string) => (path === "" ? key : `${path}.${key}`);
  for (const key in value) if (!(key in fields)) fail(at(key), "is no known key");
  const from = value as Record<string, unknown>;
  return Object.fromEntries(Object.entries(fields).map(([key, field]) => [key, readField(from[key], at(key), field)]));
}

function readField(value: unknown, path: string, field: Field): unknown {
  const { fields, text, most, longest } = field;
  if (value === undefined && "absent" in field) return field.absent;
  if (text) {
    if (typeof value !== "string" || value.length > text) fail(path, `is not a text of up to ${text} bytes`);
    return value;
  }
  const one: Read<unknown> = (item, at) => (fields ? readObject(item, at, fields) : readNumber(item, at, field));
  const entry: Read<unknown> = longest ? (item, at) => readList(item, at, longest, one) : one;
  return most ? readList(value, path, most, entry) : entry(value, path);
}

/**
 * Reads the contents of a material file. Throws an Error with a text if they are invalid. Addresses become absolute;
 * an absent width becomes 100 mm. touch.wasm checks the rules between the fields of a voice.
 */
export function parseMaterial(json: unknown, base: string): Material {
  const read = readObject(json, "", kFields) as unknown as Material;
  if (read.schema !== kSchema) fail("schema", `is not "${kSchema}"`);
  if (read.height_map !== "" && read.image === "") fail("height_map", "is given without an image");
  const absolute = (address: string) => (address === "" ? "" : new URL(address, base).href);
  read.image = absolute(read.image);
  read.height_map = absolute(read.height_map);
  read.width_mm ||= kAssumedWidthMm;
  return read;
}

/** A number is stored as it is, a list after its length, an object after a 1; a 0 means an absent object. */
function put(to: number[], value: unknown, fields: Fields = {}): void {
  if (Array.isArray(value)) {
    to.push(value.length);
    for (const item of value) put(to, item, fields);
  } else if (typeof value === "number") {
    to.push(value);
  } else if (value === undefined) {
    to.push(0);
  } else {
    to.push(1);
    for (const [key, field] of Object.entries(fields))
      if (!field.unheard) put(to, (value as Record<string, unknown>)[key], field.fields);
  }
}

/** Returns the numbers for voice_create of touch.wasm (src/material/voice_numbers.hpp). */
export function voiceNumbers(material: Material): Float64Array {
  const to: number[] = [];
  for (const key of ["level_law", "voices"] as const) put(to, material[key], kFields[key]!.fields);
  return new Float64Array(to);
}

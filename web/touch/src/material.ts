// SPDX-License-Identifier: MIT
// Material files (docs/material.md) as the page reads them.

/** What a sound is beyond coloured noise: bands whose level wanders along the way, and single grains. */
export interface Texture {
  crossovers_hz: number[];
  levels_db: number[][];
  coherence: number;
  lengths_mm: number[];
  weights: number[];
  grains: { per_mm: number; share: number; scatter: number; sizes: number[]; shape: number[] };
}

/** One learned sound: an all-pole filter and its level at a speed and a force. */
export interface VoiceModel {
  speed_mm_per_s: number;
  force_n: number;
  level_db: number;
  sample_rate_hz: number;
  reflection: number[];
  texture: Texture | undefined;
}

export interface Material {
  name: string;
  note: string;
  stiffness_n_per_mm: number;
  viscosity_n_s_per_mm: number;
  /** Width of the image as the finger feels it; what the file leaves out is taken to be 100. */
  width_mm: number;
  /** Absolute address of the image, or "" without one. */
  image: string;
  /** Absolute address of its heights, or "": its own brightness stands for them. */
  height_map: string;
  relief_slope: number;
  gloss: number;
  roughness: number;
  law: { level_db: number; db_per_decade_speed: number; db_per_decade_force: number };
  voices: VoiceModel[];
}

const kAssumedWidthMm = 100;

class MaterialError extends Error {}

function fail(key: string, what: string): never {
  throw new MaterialError(`material: ${key} ${what}`);
}

function record(value: unknown, key: string): Record<string, unknown> {
  if (typeof value !== "object" || value === null || Array.isArray(value)) fail(key, "is not an object");
  return value as Record<string, unknown>;
}

function number(from: Record<string, unknown>, key: string, least: number, most: number, absent?: number): number {
  const value = from[key];
  if (value === undefined && absent !== undefined) return absent;
  if (typeof value !== "number" || !(value >= least && value <= most)) {
    fail(key, `is not a number from ${least} to ${most}`);
  }
  return value;
}

function text(from: Record<string, unknown>, key: string): string {
  const value = from[key] ?? "";
  if (typeof value !== "string") fail(key, "is not text");
  return value;
}

function list(from: Record<string, unknown>, key: string, most: number, absent?: number[]): number[] {
  const values = from[key] ?? absent;
  if (!Array.isArray(values) || values.length > most || !values.every((v) => typeof v === "number")) {
    fail(key, `is not a list of up to ${most} numbers`);
  }
  return values;
}

function texture(value: unknown): Texture | undefined {
  if (value === undefined) return undefined;
  const from = record(value, "texture");
  const grains = record(from["grains"] ?? {}, "grains");
  const levels = from["levels_db"];
  if (!Array.isArray(levels) || levels.length > 8) fail("levels_db", "is not a list of up to 8 tables");
  const crossovers = list(from, "crossovers_hz", 7);
  if (levels.length !== crossovers.length + 1 || !levels.every((l) => Array.isArray(l) && l.length === 17)) {
    fail("levels_db", "does not have 17 levels for each band");
  }
  return {
    crossovers_hz: crossovers,
    levels_db: levels as number[][],
    coherence: number(from, "coherence", 0, 1),
    lengths_mm: list(from, "lengths_mm", 4),
    weights: list(from, "weights", 4),
    grains: {
      per_mm: number(grains, "per_mm", 0, 1e4, 0),
      share: number(grains, "share", 0, 1, 0),
      scatter: number(grains, "scatter", 0, 1, 1),
      sizes: list(grains, "sizes", 65, []),
      shape: list(grains, "shape", 64, []),
    },
  };
}

function voice(value: unknown): VoiceModel {
  const from = record(value, "voices");
  const reflection = list(from, "reflection", 128);
  if (!reflection.every((k) => Math.abs(k) < 1)) fail("reflection", "is not inside (-1, 1)");
  return {
    speed_mm_per_s: number(from, "speed_mm_per_s", 1e-6, 1e6),
    force_n: number(from, "force_n", 1e-6, 1e4, 1),
    level_db: number(from, "level_db", -200, 60),
    sample_rate_hz: number(from, "sample_rate_hz", 1000, 384000),
    reflection: reflection.map((k) => Math.min(0.999999, Math.max(-0.999999, k))),
    texture: texture(from["texture"]),
  };
}

/** The law that the recordings fit best when the file says none: 10 dB a decade through their mean. */
function fittedLaw(voices: VoiceModel[]): Material["law"] {
  const level = (v: VoiceModel) => v.level_db - 10 * Math.log10(v.speed_mm_per_s / 100) - 10 * Math.log10(v.force_n);
  const mean = voices.reduce((sum, v) => sum + level(v), 0) / Math.max(1, voices.length);
  return { level_db: mean, db_per_decade_speed: 10, db_per_decade_force: 10 };
}

/** Reads what a material file holds; throws an Error that says what is wrong. */
export function parseMaterial(json: unknown, base: string): Material {
  const from = record(json, "file");
  if (from["schema"] !== "tribo.material/1") fail("schema", 'is not "tribo.material/1"');
  const given = from["voices"] ?? [];
  if (!Array.isArray(given) || given.length > 64) fail("voices", "is not a list of up to 64");
  const voices = given.map(voice);
  let law = fittedLaw(voices);
  if (from["level_law"] !== undefined) {
    const fixed = record(from["level_law"], "level_law");
    law = {
      level_db: number(fixed, "level_db", -200, 60),
      db_per_decade_speed: number(fixed, "db_per_decade_speed", -200, 200, law.db_per_decade_speed),
      db_per_decade_force: number(fixed, "db_per_decade_force", -200, 200, law.db_per_decade_force),
    };
  }
  const image = text(from, "image");
  const heightMap = text(from, "height_map");
  if (heightMap !== "" && image === "") fail("height_map", "is given without an image");
  return {
    name: text(from, "name"),
    note: text(from, "note"),
    stiffness_n_per_mm: number(from, "stiffness_n_per_mm", 1e-3, 1e6),
    viscosity_n_s_per_mm: number(from, "viscosity_n_s_per_mm", 0, 1e6),
    width_mm: number(from, "width_mm", 0, 1e5, 0) || kAssumedWidthMm,
    image: image === "" ? "" : new URL(image, base).href,
    height_map: heightMap === "" ? "" : new URL(heightMap, base).href,
    relief_slope: number(from, "relief_slope", 0, 1, 0.2),
    gloss: number(from, "gloss", 0, 1, 0.04),
    roughness: number(from, "roughness", 0.05, 1, 0.5),
    law,
    voices,
  };
}

/** The numbers that voice_create of touch.wasm takes. */
export function voiceNumbers(m: Material): Float64Array {
  const numbers = [m.voices.length, m.law.level_db, m.law.db_per_decade_speed, m.law.db_per_decade_force];
  for (const v of m.voices) {
    numbers.push(v.speed_mm_per_s, v.force_n, v.level_db, v.sample_rate_hz, v.reflection.length, ...v.reflection);
    const t = v.texture;
    numbers.push(t?.levels_db.length ?? 0);
    if (t === undefined) continue;
    numbers.push(
      ...t.crossovers_hz,
      ...t.levels_db.flat(),
      t.coherence,
      t.lengths_mm.length,
      ...t.lengths_mm,
      ...t.weights,
    );
    const { per_mm, share, scatter, sizes, shape } = t.grains;
    numbers.push(per_mm, share, scatter, sizes.length, ...sizes, shape.length, ...shape);
  }
  return new Float64Array(numbers);
}

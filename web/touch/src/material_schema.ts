// SPDX-License-Identifier: MIT
// What may stand in a material file, out of src/material/material_schema.hpp. Not to be edited:
// tests/material/material_schema_test.cpp says what belongs here.

/** Of a number `from` or `above`, and `to`; of a text its most bytes; of a list its `most` entries. */
export interface Field {
  from?: number;
  above?: number;
  to?: number;
  text?: number;
  most?: number;
  /** Numbers in each list of a list. */
  longest?: number;
  /** What stands for it; a field without must be there. */
  absent?: unknown;
  /** Not among the voice numbers. */
  unheard?: boolean;
  fields?: Fields;
}

export type Fields = Readonly<Record<string, Field>>;

export interface LevelLaw {
  level_db: number;
  db_per_decade_speed: number;
  db_per_decade_force: number;
}

export interface Bass {
  share: number;
  sample_rate_hz: number;
  reflection: number[];
}

export interface Grains {
  per_mm: number;
  share: number;
  scatter: number;
  sizes: number[];
  shape: number[];
}

export interface Texture {
  crossovers_hz: number[];
  levels_db: number[][];
  coherence: number;
  lengths_mm: number[];
  weights: number[];
  grains: Grains | undefined;
}

export interface Recording {
  file: string;
  seconds: number;
  sample_rate_hz: number;
  channels: number;
  bits: number;
  peak_db: number;
  silent_share: number;
  clipped_share: number;
}

export interface Voice {
  speed_mm_per_s: number;
  force_n: number;
  level_db: number;
  sample_rate_hz: number;
  reflection: number[];
  line_spectrum_hz: number[];
  bass: Bass | undefined;
  texture: Texture | undefined;
  recordings: Recording[];
}

export interface Material {
  schema: string;
  name: string;
  note: string;
  stiffness_n_per_mm: number;
  viscosity_n_s_per_mm: number;
  width_mm: number;
  image: string;
  height_map: string;
  relief_slope: number;
  gloss: number;
  roughness: number;
  pile: number;
  method: string;
  highpass_hz: number;
  level_law: LevelLaw | undefined;
  voices: Voice[];
}

export const kSchema = "tribo.material/1";

export const kFields: Fields = {
  schema: { text: 10000 },
  name: { text: 10000, absent: "" },
  note: { text: 10000, absent: "" },
  stiffness_n_per_mm: { from: 0.001, to: 1e6 },
  viscosity_n_s_per_mm: { from: 0, to: 1e6 },
  width_mm: { from: 0.1, to: 1e5, absent: 0 },
  image: { text: 10000, absent: "" },
  height_map: { text: 10000, absent: "" },
  relief_slope: { from: 0, to: 1, absent: 0.2 },
  gloss: { from: 0, to: 1, absent: 0.04 },
  roughness: { from: 0.05, to: 1, absent: 0.5 },
  pile: { from: 0, to: 1, absent: 0 },
  method: { text: 10000, absent: "" },
  highpass_hz: { from: 0, to: 1e5, absent: 0 },
  level_law: {
    absent: undefined,
    fields: {
      level_db: { from: -200, to: 60 },
      db_per_decade_speed: { from: -200, to: 200 },
      db_per_decade_force: { from: -200, to: 200 },
    },
  },
  voices: {
    most: 64,
    absent: [],
    fields: {
      speed_mm_per_s: { from: 0.001, to: 1e5 },
      force_n: { from: 0.001, to: 10000, absent: 1 },
      level_db: { from: -200, to: 60 },
      sample_rate_hz: { from: 1000, to: 384000 },
      reflection: { from: -0.999999, to: 0.999999, most: 128 },
      line_spectrum_hz: { from: 0, to: 192000, most: 128, absent: [], unheard: true },
      bass: {
        absent: undefined,
        unheard: true,
        fields: {
          share: { from: 0, to: 1 },
          sample_rate_hz: { from: 2800, to: 12000 },
          reflection: { from: -0.999999, to: 0.999999, most: 128 },
        },
      },
      texture: {
        absent: undefined,
        fields: {
          crossovers_hz: { above: 0, to: 192000, most: 7 },
          levels_db: { from: -300, to: 100, most: 8, longest: 256 },
          coherence: { from: 0, to: 1 },
          lengths_mm: { above: 0, to: 1e6, most: 4 },
          weights: { from: 0, to: 1, most: 4 },
          grains: {
            absent: undefined,
            fields: {
              per_mm: { from: 0, to: 10000 },
              share: { from: 0, to: 1 },
              scatter: { from: 0, to: 1, absent: 1 },
              sizes: { from: -10000, to: 10000, most: 65 },
              shape: { from: -1, to: 1, most: 64 },
            },
          },
        },
      },
      recordings: {
        most: 256,
        absent: [],
        unheard: true,
        fields: {
          file: { text: 10000, absent: "" },
          seconds: { from: 0, to: 1e6, absent: 0 },
          sample_rate_hz: { from: 1, to: 1e7 },
          channels: { from: 1, to: 1024, absent: 1 },
          bits: { from: 0, to: 64, absent: 0 },
          peak_db: { from: -400, to: 100, absent: 0 },
          silent_share: { from: 0, to: 1, absent: 0 },
          clipped_share: { from: 0, to: 1, absent: 0 },
        },
      },
    },
  },
};

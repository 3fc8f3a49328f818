// SPDX-License-Identifier: MIT
// The surface of a part for the views of a comparison: one mesh of all its pieces, coloured by its distance from the other.

import type { ChunkFrame } from "@tribo/protocol/frames";
import { vec3, type Vec3 } from "@tribo/protocol/vec3";

/** Distances are sought up to here, mm (src/session/live/part_picture.hpp). */
export const REACH_MM = 3;
// A smaller distance is the rounding of the STL file between the two runs.
const SAME_MM = 1e-4;
// As in src/app/compare/compare_parts.cpp: the colours end where 98 of 100 places are, and not below a micrometre.
const RANGE_SHARE = 0.98;
const LEAST_RANGE_MM = 1e-3;
const STEPS = 65535;

export interface Surface {
  positions: Float32Array;
  indices: Uint32Array;
  untouched: Uint8Array;
  /** Signed, mm; +-REACH_MM also stands for more. */
  differences: Float32Array;
}

/** Where the parts are farthest apart: B leaves more, B cuts deeper. */
export interface Extremes {
  more: { mm: number; at: Vec3 } | undefined;
  less: { mm: number; at: Vec3 } | undefined;
}

// Along a surface the distance is continuous: what is beyond the reach has the sign of its neighbours.
function spread(differences: Float32Array, indices: Uint32Array): void {
  for (let changed = true; changed;) {
    changed = false;
    for (let n = 0; n < indices.length; n += 3) {
      const corners = [indices[n]!, indices[n + 1]!, indices[n + 2]!];
      const known = corners.find((k) => !Number.isNaN(differences[k]!));
      if (known === undefined) continue;
      for (const k of corners) {
        if (!Number.isNaN(differences[k]!)) continue;
        differences[k] = Math.sign(differences[known]!) * REACH_MM;
        changed = true;
      }
    }
  }
  differences.forEach((mm, n) => (differences[n] = Math.abs(mm) < SAME_MM || Number.isNaN(mm) ? 0 : mm));
}

/** `sign`: 1 for B, whose distances are from A; -1 for A. */
export function surfaceOf(pieces: readonly ChunkFrame[], sign: 1 | -1): Surface {
  const places: number[] = [];
  const untouched: number[] = [];
  const differences: number[] = [];
  const indices: number[] = [];
  const known = new Map<string, number>();
  for (const piece of pieces) {
    // Pieces meet in the same places.
    const numbers = Array.from({ length: piece.positions.length / 3 }, (_, n) => {
      const at = piece.positions.subarray(3 * n, 3 * n + 3);
      const blank = Number(n < (piece.onBlank ?? 0));
      const key = `${at.join()},${blank}`;
      const before = known.get(key);
      if (before !== undefined) return before;
      const number = untouched.length;
      known.set(key, number);
      places.push(...at);
      untouched.push(blank);
      differences.push(sign * (piece.deviations[n] ?? Number.NaN));
      return number;
    });
    for (const n of piece.indices) indices.push(numbers[n]!);
  }
  const surface = {
    positions: Float32Array.from(places),
    indices: Uint32Array.from(indices),
    untouched: Uint8Array.from(untouched),
    differences: Float32Array.from(differences),
  };
  spread(surface.differences, surface.indices);
  return surface;
}

export function extremesOf(surfaces: readonly Surface[]): Extremes {
  const found: Extremes = { more: undefined, less: undefined };
  for (const { differences, positions } of surfaces)
    differences.forEach((mm, n) => {
      const at = () => vec3((k) => positions[3 * n + k]!);
      if (mm > (found.more?.mm ?? 0)) found.more = { mm, at: at() };
      if (mm < (found.less?.mm ?? 0)) found.less = { mm, at: at() };
    });
  return found;
}

/** The value at the ends of the colours, mm. */
export function rangeOf(surfaces: readonly Surface[]): number {
  const sizes = surfaces
    .flatMap(({ differences }) => [...differences].filter((mm) => mm !== 0).map(Math.abs))
    .sort((a, b) => a - b);
  return Math.max(sizes[Math.floor(RANGE_SHARE * (sizes.length - 1))] ?? 0, LEAST_RANGE_MM);
}

/** The description and the bytes that the views take (src/report/report_part.hpp); more than 65,536 vertices have 32-bit indices. */
export function packed({ positions, indices, untouched, differences }: Surface, range: number) {
  const vertices = untouched.length;
  const axis = (k: 0 | 1 | 2) => positions.filter((_, n) => n % 3 === k);
  const lowest = vec3((k) => axis(k).reduce((least, v) => Math.min(least, v), Infinity));
  const size = vec3((k) => axis(k).reduce((most, v) => Math.max(most, v), -Infinity) - lowest[k]);
  const step = Math.max(...size) / STEPS || 1;
  const deviation_step = (2 * range) / 32767;
  const limited = (mm: number) => Math.round(Math.min(Math.max(mm, -2 * range), 2 * range) / deviation_step);
  const lists = [
    Uint16Array.from(positions, (v, n) => Math.round((v - lowest[(n % 3) as 0 | 1 | 2]) / step)),
    Int16Array.from(differences, limited),
    vertices > STEPS + 1 ? indices : Uint16Array.from(indices),
    untouched,
  ];
  const bytes = new Uint8Array(lists.reduce((sum, list) => sum + list.byteLength, 0));
  let at = 0;
  for (const list of lists) {
    bytes.set(new Uint8Array(list.buffer, list.byteOffset, list.byteLength), at);
    at += list.byteLength;
  }
  const part = {
    vertices,
    triangles: indices.length / 3,
    origin: lowest,
    step,
    deviation_step,
    deviation_range: range,
  };
  return { part, bytes };
}

// SPDX-License-Identifier: MIT
// What each finish of the part reflects of the studio: brightness by direction, blurred by the roughness, as a table over an
// octahedron that is unfolded into a square (Engelhardt and Dachsbacher 2008). As src/report/picture/studio.cpp.

import { MACHINED, PAINT, PANEL_DISTANCE, PANELS, SAWN, wallAt } from "@tribo/ui/studio";
import type { Vec3 } from "@tribo/protocol/vec3";
import { vec3 } from "./shared.js";
import { cross, dot, unit } from "./vectors.js";

export const ROOM_SIDE = 48;
const RAYS = 64;
const UP: Vec3 = [0, 0, 1];

const walls = PANELS.map(({ towards, width, height, brightness }) => {
  const out = unit([...towards]);
  const right = unit(cross(UP, out));
  return { out, right, up: cross(out, right), half: [width / 2, height / 2] as const, brightness };
});

function brightnessAt(d: Vec3): number {
  for (const wall of walls) {
    const forward = dot(d, wall.out) / PANEL_DISTANCE;
    if (
      forward > 0 &&
      Math.abs(dot(d, wall.right)) <= forward * wall.half[0] &&
      Math.abs(dot(d, wall.up)) <= forward * wall.half[1]
    )
      return wall.brightness;
  }
  return wallAt(d[2]);
}

// Van der Corput's sequence in base 2.
function radicalInverse(n: number): number {
  let share = 0;
  for (let digit = 0.5; n > 0; n >>= 1, digit /= 2) share += (n & 1) * digit;
  return share;
}
// Rays of the lobe cos^exponent about z, all of one weight.
function lobe(exponent: number): Vec3[] {
  return Array.from({ length: RAYS }, (_, n) => {
    const cosine = ((n + 0.5) / RAYS) ** (1 / (exponent + 1));
    const sine = Math.sqrt(1 - cosine * cosine);
    const angle = 2 * Math.PI * radicalInverse(n);
    return [sine * Math.cos(angle), sine * Math.sin(angle), cosine];
  });
}
// A Phong lobe of 2 / roughness^4 - 2 about the normal has a quarter of that exponent about the mirrored direction.
const glossy = ({ roughness }: { roughness: number }) => lobe(0.25 * (2 / roughness ** 4 - 2));

function directionOf(x: number, y: number): Vec3 {
  const z = 1 - Math.abs(x) - Math.abs(y);
  const sign = (v: number) => (v < 0 ? -1 : 1);
  return unit(z < 0 ? [(1 - Math.abs(y)) * sign(x), (1 - Math.abs(x)) * sign(y), z] : [x, y, z]);
}

/** Four numbers per place of the table: for machined, for sawn, for paint, and for what scatters evenly. */
export function room(): Float32Array {
  const lobes = [glossy(MACHINED), glossy(SAWN), glossy(PAINT), lobe(1)];
  const table = new Float32Array(4 * ROOM_SIDE * ROOM_SIDE);
  for (let at = 0; at < ROOM_SIDE * ROOM_SIDE; ++at) {
    const [column, row] = [at % ROOM_SIDE, Math.floor(at / ROOM_SIDE)];
    const axis = directionOf((2 * column) / (ROOM_SIDE - 1) - 1, (2 * row) / (ROOM_SIDE - 1) - 1);
    const right: Vec3 = Math.abs(axis[2]) > 0.999 ? [1, 0, 0] : unit(cross(UP, axis));
    const up = cross(axis, right);
    lobes.forEach((rays, k) => {
      let sum = 0;
      for (const [x, y, z] of rays) sum += brightnessAt(vec3((n) => x * right[n] + y * up[n] + z * axis[n]));
      table[4 * at + k] = sum / RAYS;
    });
  }
  return table;
}

// SPDX-License-Identifier: MIT
// Shapes of the tool: turned ones (shank, holder, a cutter that turns too fast to be seen) and the fluted cutter.

import { BufferAttribute, BufferGeometry } from "three";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";

// Edges sharper than this stay sharp, rad.
const CREASE = 0.7;
const AROUND = 48;
const AROUND_A_FLUTE = 24;
// Rings along the flutes for a quarter turn of the helix.
const RINGS_A_QUARTER = 10;

export type Outline = [radius: number, height: number][];

// `radius` scales the outline by the angle and the height.
function grid(outline: Outline, around: number, radius: (angle: number, height: number) => number): BufferGeometry {
  const positions = new Float32Array(3 * outline.length * around);
  const indices: number[] = [];
  outline.forEach(([r, z], ring) => {
    for (let n = 0; n < around; ++n) {
      const angle = (2 * Math.PI * n) / around;
      const away = r * radius(angle, z);
      positions.set([away * Math.cos(angle), away * Math.sin(angle), z], 3 * (ring * around + n));
      if (ring === 0) continue;
      const [a, b] = [ring * around + n, ring * around + ((n + 1) % around)];
      indices.push(a - around, b - around, b, a - around, b, a);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(indices);
  return toCreasedNormals(geometry, CREASE);
}

// The outline turned about z, from the bottom up.
export function turned(outline: Outline): BufferGeometry {
  return grid(outline, AROUND, () => 1);
}

/**
 * The radius of a fluted cutter as a share of its outline. `share` 0 to 1 runs from a cutting edge over its land and the
 * gullet to the next edge, against the turn of the spindle.
 */
export function fluteSection(share: number): number {
  const land = 0.3;
  const rake = 0.93;
  if (share < land) return 1 - 0.1 * share;
  const deep = 0.52;
  const from = 1 - 0.1 * land;
  if (share < rake) return from + (deep - from) * Math.sin(((share - land) / (rake - land)) * 0.5 * Math.PI);
  return deep + ((share - rake) / (1 - rake)) * (1 - deep);
}

// Heights between the points of the outline, at most `step` apart.
function refined(outline: Outline, step: number): Outline {
  const out = outline.slice(0, 1);
  outline.slice(1).forEach(([r, z], n) => {
    const [r0, z0] = outline[n]!;
    const parts = Math.max(1, Math.ceil((z - z0) / step));
    for (let k = 1; k <= parts; ++k) out.push([r0 + (k / parts) * (r - r0), z0 + (k / parts) * (z - z0)]);
  });
  return out;
}

/** A right-handed cutter with its edges wound by the helix angle, rad. */
export function fluted(outline: Outline, flutes: number, helix: number): BufferGeometry {
  const largest = Math.max(...outline.map(([r]) => r), 1e-6);
  const wind = Math.tan(helix) / largest;
  const height = outline.at(-1)![1];
  const step = wind > 0 ? Math.PI / 2 / RINGS_A_QUARTER / wind : height;
  const pitch = (2 * Math.PI) / flutes;
  return grid(refined(outline, Math.max(step, height / 400)), AROUND_A_FLUTE * flutes, (angle, z) => {
    const share = (angle - wind * z) / pitch;
    return fluteSection(share - Math.floor(share));
  });
}

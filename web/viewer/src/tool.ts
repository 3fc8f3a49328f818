// SPDX-License-Identifier: MIT
// The outline of a tool: points (radius, height above the tip) from the axis at the bottom to the axis at the top.

import type { Cutter } from "./frames.js";

const CORNER_STEPS = 12;

export function outline(cutter: Cutter): [number, number][] {
  const { radius, corner, length, holder } = cutter;
  const points: [number, number][] = [[0, 0]];
  for (let n = corner > 0 ? 0 : CORNER_STEPS; n <= CORNER_STEPS; ++n) {
    const a = (n / CORNER_STEPS) * (Math.PI / 2);
    points.push([radius - corner + corner * Math.sin(a), corner - corner * Math.cos(a)]);
  }
  points.push([radius, length]);
  let z = length;
  for (const step of holder) {
    points.push([step.radius, z], [step.radius, z + step.length]);
    z += step.length;
  }
  points.push([0, z]);
  return points;
}

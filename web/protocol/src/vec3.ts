// SPDX-License-Identifier: MIT
// Three numbers, one per axis.

export type Vec3 = [number, number, number];
export type Axis = 0 | 1 | 2;

export function vec3(of: (axis: Axis) => number): Vec3 {
  return [of(0), of(1), of(2)];
}

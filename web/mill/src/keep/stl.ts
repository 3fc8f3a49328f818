// SPDX-License-Identifier: MIT
// The part as a binary STL file.

import type { Triangles } from "./triangles.js";

const HEADER = 80;
const TRIANGLE = 50;

export function stl(pieces: readonly Triangles[]): ArrayBuffer {
  const count = pieces.reduce((sum, { indices }) => sum + indices.length / 3, 0);
  const file = new ArrayBuffer(HEADER + 4 + TRIANGLE * count);
  new Uint8Array(file).set(new TextEncoder().encode("Tribo: machined part, mm"));
  const view = new DataView(file);
  view.setUint32(HEADER, count, true);
  let at = HEADER + 4;
  for (const { positions, indices } of pieces) {
    for (let n = 0; n < indices.length; n += 3) {
      const corner = (k: number, axis: number) => positions[3 * indices[n + k]! + axis]!;
      const edge = (k: number, axis: number) => corner(k, axis) - corner(0, axis);
      const normal = [0, 1, 2].map((axis) => {
        const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        return edge(1, u) * edge(2, v) - edge(1, v) * edge(2, u);
      });
      const size = Math.hypot(...normal) || 1;
      normal.forEach((value, axis) => view.setFloat32(at + 4 * axis, value / size, true));
      for (let k = 0; k < 3; ++k)
        for (let axis = 0; axis < 3; ++axis) view.setFloat32(at + 12 + 12 * k + 4 * axis, corner(k, axis), true);
      at += TRIANGLE;
    }
  }
  return file;
}

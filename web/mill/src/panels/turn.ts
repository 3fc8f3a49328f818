// SPDX-License-Identifier: MIT
// The force over a spindle turn and its spectrum, from the harmonics of a piece of the cut.

import type { Piece } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";

export interface Turn {
  degrees: number[];
  x: number[];
  y: number[];
  z: number[];
}

// F(angle) = mean + 2 Re sum h_n e^(i n step angle), in the frame of the tool.
export function turn(piece: Piece, steps = 360): Turn {
  const out: Turn = { degrees: [], x: [], y: [], z: [] };
  const h = piece.harmonics;
  for (let n = 0; n <= steps; ++n) {
    const angle = (2 * Math.PI * n) / steps;
    const force: Vec3 = [h[0] ?? 0, h[2] ?? 0, h[4] ?? 0];
    for (let order = 1; 6 * order < h.length; ++order) {
      const c = 2 * Math.cos(order * piece.orderStep * angle);
      const s = 2 * Math.sin(order * piece.orderStep * angle);
      for (const k of [0, 1, 2] as const) force[k] += h[6 * order + 2 * k]! * c - h[6 * order + 2 * k + 1]! * s;
    }
    out.degrees.push((360 * n) / steps);
    out.x.push(force[0]);
    out.y.push(force[1]);
    out.z.push(force[2]);
  }
  return out;
}

// Amplitudes of the force normal to the axis, N, over Hz, without the mean.
export function spectrum(piece: Piece): { hz: number[]; newton: number[] } {
  const out = { hz: [] as number[], newton: [] as number[] };
  const h = piece.harmonics;
  for (let order = 1; 6 * order < h.length; ++order) {
    const k = 6 * order;
    out.hz.push((order * piece.orderStep * piece.radPerS) / (2 * Math.PI));
    out.newton.push(2 * Math.hypot(...h.subarray(k, k + 4)));
  }
  return out;
}

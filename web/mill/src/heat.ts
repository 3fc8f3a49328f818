// SPDX-License-Identifier: MIT
// A scale of colours that rises evenly in lightness and that colour-blind eyes can read: from deep blue over
// green to yellow (five stops of Viridis; van der Walt & Smith 2015).

import { vec3, type Vec3 } from "@tribo/protocol/vec3";

const STOPS: Vec3[] = [
  [0.267, 0.005, 0.329],
  [0.229, 0.322, 0.546],
  [0.128, 0.567, 0.551],
  [0.369, 0.789, 0.383],
  [0.993, 0.906, 0.144],
];

// share 0..1, clamped.
export function heat(share: number): Vec3 {
  const at = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const n = Math.min(Math.floor(at), STOPS.length - 2);
  const t = at - n,
    low = STOPS[n]!,
    high = STOPS[n + 1]!;
  return vec3((k) => low[k] + t * (high[k] - low[k]));
}

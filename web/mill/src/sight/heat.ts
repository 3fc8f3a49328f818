// SPDX-License-Identifier: MIT
// A colour scale with uniformly increasing lightness, readable for colour-blind users: from deep blue over green to
// yellow (five stops of Viridis; van der Walt & Smith 2015).

import type { Vec3 } from "@tribo/protocol/vec3";
import { between } from "@tribo/ui/colours";

const STOPS: Vec3[] = [
  [0.267, 0.005, 0.329],
  [0.229, 0.322, 0.546],
  [0.128, 0.567, 0.551],
  [0.369, 0.789, 0.383],
  [0.993, 0.906, 0.144],
];

/** `share` 0 to 1, clamped. */
export const heat = (share: number): Vec3 => between(STOPS, share);

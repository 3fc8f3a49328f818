// SPDX-License-Identifier: MIT
import { vec3, type Vec3 } from "@tribo/protocol/vec3";

/** Interpolates between two or more evenly spaced colours; share 0 to 1, clamped. */
export function between(stops: readonly Vec3[], share: number): Vec3 {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const n = Math.min(Math.floor(at), stops.length - 2);
  const low = stops[n]!;
  const high = stops[n + 1]!;
  return vec3((k) => low[k] + (at - n) * (high[k] - low[k]));
}

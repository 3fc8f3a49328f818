// SPDX-License-Identifier: MIT
// Where the camera stands so that what it shows fills the free part of the window.

import { type Box3, type PerspectiveCamera, Vector3 } from "three";

// The part of the canvas that no panel covers, CSS pixels from its corner.
export interface Free {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Moves the centre of the picture to the centre of the free part. */
export function centre(camera: PerspectiveCamera, width: number, height: number, free: Free): void {
  const right = free.x + free.width / 2 - width / 2;
  const down = free.y + free.height / 2 - height / 2;
  camera.setViewOffset(width, height, -right, -down, width, height);
}

/** The corners of a box. */
export function cornersOf({ min, max }: Box3): Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    (corner) => new Vector3(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z),
  );
}

/**
 * Returns the nearest place of an eye that sees all points in a share of the window, with the direction `towards` (unit)
 * from what it looks at. It looks at a point as deep as `middle`.
 */
export function eyeFor(
  points: readonly Vector3[],
  middle: Vector3,
  towards: Vector3,
  camera: PerspectiveCamera,
  share: { width: number; height: number },
): { target: Vector3; distance: number } {
  const side = new Vector3().crossVectors(camera.up, towards).normalize();
  const above = new Vector3().crossVectors(towards, side);
  const tan = Math.tan((camera.fov * Math.PI) / 360);
  // Along an axis of the picture an eye at (a, depth) sees a point (b, c) where |b - a| <= slope (depth - c).
  const [x, y] = (
    [
      [side, tan * camera.aspect * share.width],
      [above, tan * share.height],
    ] as const
  ).map(([axis, slope]) => {
    let [low, high] = [-Infinity, -Infinity];
    for (const point of points) {
      const [along, near] = [point.dot(axis), slope * point.dot(towards)];
      low = Math.max(low, near - along);
      high = Math.max(high, near + along);
    }
    return { at: (high - low) / 2, depth: (high + low) / (2 * slope) };
  });
  const depth = middle.dot(towards);
  const target = new Vector3()
    .addScaledVector(side, x!.at)
    .addScaledVector(above, y!.at)
    .addScaledVector(towards, depth);
  return { target, distance: Math.max(x!.depth, y!.depth) - depth };
}

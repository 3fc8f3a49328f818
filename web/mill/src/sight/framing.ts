// SPDX-License-Identifier: MIT
// Where the camera stands so that a box fills the free part of the window.

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

/**
 * Returns the distance from the centre of the box at which all of it is seen from the direction `towards` (unit) in a
 * share of the window.
 */
export function distanceTo(
  box: Box3,
  towards: Vector3,
  camera: PerspectiveCamera,
  share: { width: number; height: number },
): number {
  const middle = box.getCenter(new Vector3());
  const side = new Vector3().crossVectors(camera.up, towards).normalize();
  const above = new Vector3().crossVectors(towards, side);
  const tan = Math.tan((camera.fov * Math.PI) / 360);
  let distance = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const p = new Vector3(
      corner & 1 ? box.max.x : box.min.x,
      corner & 2 ? box.max.y : box.min.y,
      corner & 4 ? box.max.z : box.min.z,
    ).sub(middle);
    const needed = Math.max(
      Math.abs(p.dot(side)) / (tan * camera.aspect * share.width),
      Math.abs(p.dot(above)) / (tan * share.height),
    );
    distance = Math.max(distance, p.dot(towards) + needed);
  }
  return distance;
}

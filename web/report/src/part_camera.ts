// SPDX-License-Identifier: MIT
// The camera of the part: an eye that moves around a target, z up.

import type { Vec3 } from "@tribo/protocol/vec3";
import { clamp, vec3 } from "./shared.js";
import { cross, dot } from "./vectors.js";

const HALF_VIEW = Math.tan((0.5 * 27 * Math.PI) / 180);
// Start direction around the part.
const ROOM = 1.06;

const add = (a: Vec3, b: Vec3, s = 1): Vec3 => vec3((k) => a[k] + s * b[k]);

interface Eye {
  /** About z, and above the horizontal plane, rad. */
  turn: number;
  rise: number;
  near: number;
  target: Vec3;
}

/** Unit vectors: out of the picture, to its right, upwards. */
function axes({ turn, rise }: Eye): { back: Vec3; right: Vec3; up: Vec3 } {
  const back: Vec3 = [Math.cos(rise) * Math.cos(turn), Math.cos(rise) * Math.sin(turn), Math.sin(rise)];
  const right: Vec3 = [-Math.sin(turn), Math.cos(turn), 0];
  return { back, right, up: cross(back, right) };
}

export class Camera {
  readonly #start: Eye;
  #eye: Eye;
  readonly #centre: Vec3;
  readonly #half: Vec3;

  /** The centre of a box and half of its size. */
  constructor(centre: Vec3, half: Vec3) {
    this.#centre = centre;
    this.#half = half;
    const rise = Math.atan2(0.9, Math.hypot(0.55, 1));
    this.#start = { turn: Math.atan2(-1, 0.55), rise, near: 1, target: centre };
    this.#eye = { ...this.#start };
  }

  home(): void {
    this.#eye = { ...this.#start };
  }
  turnBy(dx: number, dy: number): void {
    this.#eye.turn -= dx;
    this.#eye.rise = clamp(this.#eye.rise + dy, -1.55, 1.55);
  }
  /** Direction of the eye about z, rad. */
  get turn(): number {
    return this.#eye.turn;
  }
  nearer(factor: number): void {
    this.#eye.near = clamp(this.#eye.near * factor, 0.3, 60);
  }
  /** In pixels of a canvas of that size. */
  shift(dx: number, dy: number, width: number, height: number): void {
    const { right, up } = axes(this.#eye);
    const mm = (2 * HALF_VIEW * this.#distance(width / height)) / height;
    this.#eye.target = add(add(this.#eye.target, right, -dx * mm), up, dy * mm);
  }

  /** The position of the eye, and the matrix to clip space, by columns. */
  view(aspect: number): { from: Vec3; matrix: Float32Array } {
    const far = this.#distance(aspect);
    const { back, right, up } = axes(this.#eye);
    const from = add(this.#eye.target, back, far);
    // The whole part is between these distances, from every direction.
    const radius = Math.max(Math.hypot(...this.#half), 1e-6);
    const deep = radius + Math.hypot(...add(this.#centre, this.#eye.target, -1));
    const n = Math.max(far - deep, 1e-3 * radius);
    const f = far + deep;
    const fy = 1 / HALF_VIEW;
    const a = (f + n) / (n - f);
    const b = (2 * f * n) / (n - f);
    const row = (axis: Vec3) => [...axis, -dot(axis, from)];
    const x = row(right).map((v) => (fy / aspect) * v);
    const y = row(up).map((v) => fy * v);
    const z = row(back);
    return {
      from,
      matrix: new Float32Array([0, 1, 2, 3].flatMap((k) => [x[k]!, y[k]!, a * z[k]! + (k === 3 ? b : 0), -z[k]!])),
    };
  }

  /** The distance at which the whole part is visible at the start. */
  #distance(aspect: number): number {
    const { back, right, up } = axes(this.#start);
    let far = 0;
    for (let n = 0; n < 8; ++n) {
      const c = vec3((k) => ((n >> k) & 1 ? this.#half[k] : -this.#half[k]));
      far = Math.max(far, dot(back, c) + Math.max(Math.abs(dot(right, c)) / aspect, Math.abs(dot(up, c))) / HALF_VIEW);
    }
    return (ROOM * far) / this.#eye.near;
  }
}

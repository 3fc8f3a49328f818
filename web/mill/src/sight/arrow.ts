// SPDX-License-Identifier: MIT
// An arrow with a body, visible from every side.

import { Color, ConeGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Quaternion, Vector3 } from "three";

import type { Vec3 } from "@tribo/protocol/vec3";

const Y = new Vector3(0, 1, 0);
const SHAFT = new CylinderGeometry(1, 1, 1, 16).translate(0, 0.5, 0);
const HEAD = new ConeGeometry(1, 1, 20).translate(0, 0.5, 0);

export class Arrow extends Group {
  private readonly paint: MeshStandardMaterial;
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor(colour: number) {
    super();
    this.paint = new MeshStandardMaterial({ color: colour, roughness: 0.5 });
    this.shaft = new Mesh(SHAFT, this.paint);
    this.head = new Mesh(HEAD, this.paint);
    this.add(this.shaft, this.head);
  }

  setColor(colour: number): void {
    this.paint.color = new Color(colour);
  }

  // Draws the arrow from `at` along `force`; a force of magnitude `largest` gets the length `longest`, in mm.
  point(at: Vec3, force: Vec3, longest: number, largest: number): void {
    const size = Math.hypot(...force);
    const length = Math.min(Math.max((longest * size) / largest, 0.1 * longest), 1.5 * longest);
    const width = 0.025 * longest;
    const tip = Math.min(0.35 * length, 7 * width);
    this.position.set(...at);
    this.quaternion.copy(new Quaternion().setFromUnitVectors(Y, new Vector3(...force).normalize()));
    this.shaft.scale.set(width, length - tip, width);
    this.head.position.y = length - tip;
    this.head.scale.set(2.6 * width, tip, 2.6 * width);
  }
}

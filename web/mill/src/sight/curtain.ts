// SPDX-License-Identifier: MIT
// The force curtain: a ribbon that stands on the path behind the tool. Height and colour are the peak force.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial } from "three";

import type { Row } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";

const CAPACITY = 4096;
const OPACITY = 0.72;

export class Curtain {
  readonly mesh: Mesh;
  private readonly position = new BufferAttribute(new Float32Array(6 * CAPACITY), 3);
  private readonly colour = new BufferAttribute(new Float32Array(8 * CAPACITY), 4);
  private readonly c = new Color();

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("color", this.colour);
    const indices: number[] = [];
    for (let n = 0; n + 1 < CAPACITY; ++n) indices.push(2 * n, 2 * n + 2, 2 * n + 1, 2 * n + 1, 2 * n + 2, 2 * n + 3);
    geometry.setIndex(indices);
    geometry.setDrawRange(0, 0);
    this.mesh = new Mesh(
      geometry,
      new MeshBasicMaterial({
        vertexColors: true,
        transparent: true,
        side: DoubleSide,
        depthWrite: false,
        toneMapped: false,
      }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 2;
  }

  // `height`: mm of a share of 1. `share`: of the largest force.
  show(rows: readonly Row[], height: number, share: (row: Row) => number, colourOf: (row: Row) => Vec3): void {
    const from = Math.max(0, rows.length - CAPACITY);
    for (let n = from; n < rows.length; ++n) {
      const row = rows[n]!;
      const at = 2 * (n - from);
      const [x, y, z] = row.tip;
      this.position.setXYZ(at, x, y, z);
      this.position.setXYZ(at + 1, x, y, z + height * share(row));
      this.c.setRGB(...colourOf(row), "srgb");
      // It fades towards its older end.
      const alpha = OPACITY * (0.35 + (0.65 * (n - from + 1)) / (rows.length - from));
      this.colour.setXYZW(at, this.c.r, this.c.g, this.c.b, 0.35 * alpha);
      this.colour.setXYZW(at + 1, this.c.r, this.c.g, this.c.b, alpha);
    }
    this.position.needsUpdate = this.colour.needsUpdate = true;
    this.mesh.geometry.setDrawRange(0, 6 * Math.max(0, rows.length - from - 1));
  }

  hide(): void {
    this.mesh.geometry.setDrawRange(0, 0);
  }
}

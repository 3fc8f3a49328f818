// SPDX-License-Identifier: MIT
// The tool path: thin where there are no rows yet, coloured where it was cut.

import { BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments } from "three";

import type { PathFrame, Row } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";

// Largest gap between consecutive rows, s.
export const SAME_CUT_S = 1e-6;

const FEED_OPACITY = 0.35;
const RAPID_OPACITY = 0.12;

/** The points of the ways that are rapid, or that are not, in pairs. `rapid`: of the way that ends at each point. */
export function waysOf(rapid: Uint8Array, wanted: boolean): number[] {
  const ways: number[] = [];
  for (let n = 1; n < rapid.length; ++n) if ((rapid[n] !== 0) === wanted) ways.push(n - 1, n);
  return ways;
}

export class PathLines {
  readonly group = new Group();
  private cut: LineSegments | undefined;
  private rows: Row[] = [];
  private drawn = 0;
  private range: [number, number] = [0, 0];
  private planned: LineSegments[] = [];
  private largest = 0;
  private colourOf: (row: Row) => Vec3 = () => [0, 0, 0];

  // A new job.
  begin(): void {
    for (const line of this.group.children as LineSegments[]) line.geometry.dispose();
    this.group.clear();
    this.planned = [];
    this.cut = undefined;
    this.forgetRows();
  }

  // Rapids are fainter than feeds.
  take(path: PathFrame): void {
    const points = new BufferAttribute(path.points, 3);
    for (const rapid of [false, true]) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", points);
      geometry.setIndex(waysOf(path.rapid, rapid));
      const opacity = rapid ? RAPID_OPACITY : FEED_OPACITY;
      const line = new LineSegments(geometry, new LineBasicMaterial({ color: 0x8a93a0, transparent: true, opacity }));
      this.planned.push(line);
      this.group.add(line);
    }
  }

  // Shows the rows [from, to), and the path without rows or not.
  show(range: [number, number], planned: boolean): void {
    this.range = range;
    for (const line of this.planned) line.visible = planned;
    this.cut?.geometry.setDrawRange(2 * range[0], 2 * (Math.min(range[1], this.drawn) - range[0]));
  }

  forgetRows(): void {
    this.rows = [];
    this.drawn = 0;
    this.largest = 0;
    this.cut?.geometry.setDrawRange(0, 0);
  }

  // `largest` is the end of the scale. When it grows, all colours change.
  add(rows: Row[], colourOf: (row: Row) => Vec3, largest: number): void {
    for (const row of rows) this.rows.push(row);
    this.colourOf = colourOf;
    if (largest > this.largest) this.drawn = 0;
    this.largest = largest;
    this.update();
  }

  recolour(colourOf: (row: Row) => Vec3): void {
    this.colourOf = colourOf;
    this.drawn = 0;
    this.update();
  }

  // Row number `first` and those after it look different now.
  recolourFrom(first: number): void {
    this.drawn = Math.min(this.drawn, first);
    this.update();
  }

  private update(): void {
    const needed = this.rows.length;
    let capacity = this.cut ? this.cut.geometry.getAttribute("position").count / 2 : 0;
    if (!this.cut || capacity < needed) {
      capacity = Math.max(1024, 2 * needed);
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(6 * capacity), 3));
      geometry.setAttribute("color", new BufferAttribute(new Float32Array(6 * capacity), 3));
      if (this.cut) {
        this.cut.geometry.dispose();
        this.group.remove(this.cut);
      }
      this.cut = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true }));
      this.cut.frustumCulled = false;
      this.group.add(this.cut);
      this.drawn = 0;
    }
    const position = this.cut.geometry.getAttribute("position") as BufferAttribute;
    const colour = this.cut.geometry.getAttribute("color") as BufferAttribute;
    const c = new Color();
    for (let n = this.drawn; n < needed; ++n) {
      const row = this.rows[n]!;
      const before = this.rows[n - 1];
      const joined = before && row.time - before.time - before.duration < SAME_CUT_S;
      position.setXYZ(2 * n, ...(joined ? before.tip : row.tip));
      position.setXYZ(2 * n + 1, ...row.tip);
      c.setRGB(...this.colourOf(row), "srgb");
      colour.setXYZ(2 * n, c.r, c.g, c.b);
      colour.setXYZ(2 * n + 1, c.r, c.g, c.b);
    }
    this.drawn = needed;
    position.needsUpdate = true;
    colour.needsUpdate = true;
    this.show(this.range, this.planned[0]?.visible ?? false);
  }
}

// SPDX-License-Identifier: MIT
// Signed distance to a triangle surface: how far a machined point is off the designed one. A grid of cells
// holds the triangles; a point asks the cells around it, ring by ring.

import { vec3, type Axis, type Vec3 } from "@tribo/protocol/vec3";

const CELLS_PER_SIDE = 48;

export class SurfaceDistance {
  private positions: number[] = [];
  private triangles: number[] = [];
  private cells = new Map<number, number[]>();
  private origin: Vec3 = [0, 0, 0];
  private size = 1;
  private built = false;

  get empty(): boolean {
    return this.triangles.length === 0;
  }

  add(positions: Float32Array, indices: Uint16Array): void {
    const first = this.positions.length / 3;
    for (const v of positions) this.positions.push(v);
    for (const n of indices) this.triangles.push(first + n);
    this.built = false;
  }

  // Positive on the side of the normals; none farther than `reach` is looked for: NaN then.
  at(p: Vec3, reach: number): number {
    if (!this.built) this.build();
    const c = vec3((axis) => Math.floor((p[axis] - this.origin[axis]) / this.size));
    let best = reach * reach;
    let sign = Number.NaN;
    const rings = Math.ceil(reach / this.size) + 1;
    for (let ring = 0; ring <= rings; ++ring) {
      if (ring > 1 && ((ring - 1) * this.size) ** 2 > best) break;
      for (let i = -ring; i <= ring; ++i) {
        for (let j = -ring; j <= ring; ++j) {
          const shell = Math.abs(i) === ring || Math.abs(j) === ring;
          for (let k = -ring; k <= ring; k += shell || ring === 0 ? 1 : 2 * ring) {
            for (const t of this.cells.get(key(c[0] + i, c[1] + j, c[2] + k)) ?? []) {
              const d = this.squared(t, p);
              if (Math.abs(d) < best || (Math.abs(d) === best && Number.isNaN(sign))) {
                best = Math.abs(d);
                sign = d < 0 ? -1 : 1;
              }
            }
          }
        }
      }
    }
    return sign * Math.sqrt(best);
  }

  private build(): void {
    const min: Vec3 = [Infinity, Infinity, Infinity];
    const max: Vec3 = [-Infinity, -Infinity, -Infinity];
    this.positions.forEach((v, n) => {
      const axis = (n % 3) as Axis;
      min[axis] = Math.min(min[axis], v);
      max[axis] = Math.max(max[axis], v);
    });
    this.origin = min;
    this.size = Math.max(max[0] - min[0], max[1] - min[1], max[2] - min[2], 1e-6) / CELLS_PER_SIDE;
    this.cells.clear();
    for (let t = 0; t < this.triangles.length / 3; ++t) {
      const low: Vec3 = [Infinity, Infinity, Infinity];
      const high: Vec3 = [-Infinity, -Infinity, -Infinity];
      for (let corner = 0; corner < 3; ++corner) {
        const p = this.corner(t, corner);
        for (const axis of [0, 1, 2] as const) {
          const at = Math.floor((p[axis] - this.origin[axis]) / this.size);
          low[axis] = Math.min(low[axis], at);
          high[axis] = Math.max(high[axis], at);
        }
      }
      for (let i = low[0]; i <= high[0]; ++i) {
        for (let j = low[1]; j <= high[1]; ++j) {
          for (let k = low[2]; k <= high[2]; ++k) {
            const cell = this.cells.get(key(i, j, k));
            if (cell) cell.push(t);
            else this.cells.set(key(i, j, k), [t]);
          }
        }
      }
    }
    this.built = true;
  }

  private corner(t: number, n: number): Vec3 {
    const at = 3 * this.triangles[3 * t + n]!;
    return vec3((axis) => this.positions[at + axis]!);
  }

  // Squared distance to a triangle, negative behind it.
  private squared(t: number, p: Vec3): number {
    const a = this.corner(t, 0);
    const ab = minus(this.corner(t, 1), a);
    const ac = minus(this.corner(t, 2), a);
    const ap = minus(p, a);
    const n = cross(ab, ac);
    const side = dot(n, ap) < 0 ? -1 : 1;
    const off = minus(ap, closest(ab, ac, ap));
    return side * dot(off, off);
  }
}

function key(i: number, j: number, k: number): number {
  return ((i + 1024) * 4096 + (j + 1024)) * 4096 + (k + 1024);
}
function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}
function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
function mix(ab: Vec3, ac: Vec3, v: number, w: number): Vec3 {
  return [v * ab[0] + w * ac[0], v * ab[1] + w * ac[1], v * ab[2] + w * ac[2]];
}

// Of the triangle 0, ab, ac the point nearest to ap, by the regions of its corners and edges (Ericson 2005,
// section 5.1.5).
function closest(ab: Vec3, ac: Vec3, ap: Vec3): Vec3 {
  const d1 = dot(ab, ap);
  const d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return [0, 0, 0];
  const bp = minus(ap, ab);
  const d3 = dot(ab, bp);
  const d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return ab;
  const vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return mix(ab, ac, d1 / (d1 - d3), 0);
  const cp = minus(ap, ac);
  const d5 = dot(ab, cp);
  const d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return ac;
  const vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return mix(ab, ac, 0, d2 / (d2 - d6));
  const va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const w = (d4 - d3) / (d4 - d3 + d5 - d6);
    return mix(ab, ac, 1 - w, w);
  }
  const sum = va + vb + vc;
  return sum === 0 ? [0, 0, 0] : mix(ab, ac, vb / sum, vc / sum);
}

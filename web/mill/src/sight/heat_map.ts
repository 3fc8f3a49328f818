// SPDX-License-Identifier: MIT
// Colours a point of the machined surface by the cut that made it (force, chip, chatter), or by its distance from the designed
// surface.

import type { ChipVerdict, Cutter, Row } from "@tribo/protocol/frames";
import { growthColour } from "./chatter_colours.js";
import { heat } from "./heat.js";
import { vec3, type Vec3 } from "@tribo/protocol/vec3";

export type Colouring = "plain" | "force" | "chip" | "chatter" | "deviation" | "scallop";

const RUBBING: Vec3 = [0.55, 0.3, 0.75];
const UNKNOWN: Vec3 = [0.54, 0.58, 0.63];
const OVERLOAD: Vec3 = [0.85, 0.2, 0.12];

// From blue over white to red; share -1 ... 1.
export function diverging(share: number): Vec3 {
  const s = Math.min(Math.max(share, -1), 1);
  const end: Vec3 = s < 0 ? [0.7, 0.09, 0.17] : [0.13, 0.4, 0.67];
  return vec3((k) => 0.95 + Math.abs(s) * (end[k] - 0.95));
}

// A line of the program with chips out of range: its worst chip and the time of it.
export interface ChipMark {
  line: number;
  verdict: Exclude<ChipVerdict, "">;
  chip: number;
  time: number;
}

interface Cut {
  row: Row;
  radius: number;
  corner: number;
}

export class HeatMap {
  private cells = new Map<number, Cut[]>();
  private marks = new Map<string, ChipMark>();
  private cutters: Cutter[] = [];
  private size = 1;
  largestForce = 1;
  largestChip = 1e-3;
  readonly scale = { deviation: 0.1 };

  begin(cutters: Cutter[]): void {
    this.cutters = cutters;
    this.cells.clear();
    this.marks.clear();
    this.size = Math.max(...cutters.map((c) => c.radius), 0.1);
    this.largestForce = 1;
    this.largestChip = 1e-3;
  }

  add(row: Row): void {
    const cutter = this.cutters[row.cutter];
    if (!cutter) return;
    this.largestForce = Math.max(this.largestForce, row.peakForce);
    this.largestChip = Math.max(this.largestChip, row.chip);
    this.mark(row);
    const key = this.key(row.tip);
    const cut = { row, radius: cutter.radius, corner: cutter.corner };
    const cell = this.cells.get(key);
    if (cell) cell.push(cut);
    else this.cells.set(key, [cut]);
  }

  // The cut that made a point of the part.
  rowAt(p: Vec3): Row | undefined {
    return this.cutAt(p)?.row;
  }

  // Sorted by line.
  chipMarks(): ChipMark[] {
    return [...this.marks.values()].sort((a, b) => a.line - b.line);
  }

  // `off`: distance of the point from the designed surface, mm; NaN if unknown.
  colour(mode: Colouring, p: Vec3, off: number): Vec3 | undefined {
    if (mode === "deviation" || mode === "scallop") {
      if (Number.isNaN(off)) return undefined;
      return mode === "deviation" ? diverging(off / this.scale.deviation) : heat(off / this.scale.deviation);
    }
    const cut = this.cutAt(p);
    if (!cut) return undefined;
    return mode === "chatter" ? growthColour(cut.row.multiplier) : this.ofRow(mode, cut.row);
  }

  ofRow(mode: Colouring, row: Row): Vec3 {
    if (mode === "chatter") return growthColour(row.multiplier) ?? UNKNOWN;
    if (mode !== "chip") return heat(row.peakForce / this.largestForce);
    if (row.chipVerdict) return row.chipVerdict === "rubbing" ? RUBBING : OVERLOAD;
    return heat(row.chip / this.largestChip);
  }

  private mark({ line, chip, chipVerdict: verdict, time }: Row): void {
    if (!verdict) return;
    const key = `${line} ${verdict}`;
    const before = this.marks.get(key);
    const worse = !before || (verdict === "rubbing" ? chip < before.chip : chip > before.chip);
    if (worse) this.marks.set(key, { line, verdict, chip, time });
  }

  // Returns the cut whose cutter surface is closest to the point; of equally close cuts the latest.
  private cutAt(p: Vec3): Cut | undefined {
    let best: Cut | undefined;
    let error = 0.25 * this.size;
    for (let i = -1; i <= 1; ++i) {
      for (let j = -1; j <= 1; ++j) {
        for (let k = -2; k <= 1; ++k) {
          const near: Vec3 = [p[0] + i * this.size, p[1] + j * this.size, p[2] + k * this.size];
          for (const cut of this.cells.get(this.key(near)) ?? []) {
            const off = Math.abs(clearance(cut, p));
            if (off < error - 1e-3 || (off < error + 1e-3 && (!best || cut.row.time > best.row.time))) {
              best = cut;
              error = Math.min(error, off);
            }
          }
        }
      }
    }
    return best;
  }

  private key(p: Vec3): number {
    const at = vec3((k) => Math.floor(p[k] / this.size) + 2048);
    return (at[0] * 4096 + at[1]) * 4096 + at[2];
  }
}

// Returns the distance of a point to the cutter, negative inside. The cutter has no upper end.
function clearance(cut: Cut, p: Vec3): number {
  const { tip, axis } = cut.row;
  const d: Vec3 = [p[0] - tip[0], p[1] - tip[1], p[2] - tip[2]];
  const height = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
  const away = Math.sqrt(Math.max(d[0] ** 2 + d[1] ** 2 + d[2] ** 2 - height ** 2, 0));
  const out = away - (cut.radius - cut.corner);
  const below = cut.corner - height;
  const outside = Math.hypot(Math.max(out, 0), Math.max(below, 0));
  return outside > 0 ? outside - cut.corner : Math.max(out, below) - cut.corner;
}

// SPDX-License-Identifier: MIT
// The pass at hand: the cut since the tool was last in the air, as a line on the part and as the force curtain. All
// passes, and the path that is still to come, by choice.

import { Group } from "three";

import type { PathFrame, Row } from "@tribo/protocol/frames";
import { begunAt } from "../rows.js";
import { Curtain } from "./curtain.js";
import type { Colouring, HeatMap } from "./heat_map.js";
import { PathLines, SAME_CUT_S } from "./path_lines.js";

export type PassShown = "pass" | "all" | "none";

// Height of the curtain for the largest force, as a share of the size of the part.
const HEIGHT = 0.22;
// A cut that never leaves the part, as a spiral, is shown on its last piece; in sizes of the part.
const LONGEST = 1.2;

/** The rows [from, to) that are cut without a gap up to a time; none in the air. Rows are in the order of time. */
export function passAt(rows: readonly Row[], time: number): [number, number] {
  const to = begunAt(rows, time);
  const last = rows[to - 1];
  if (!last || time > last.time + last.duration + SAME_CUT_S) return [to, to];
  let from = to - 1;
  for (; from > 0; --from) {
    const before = rows[from - 1]!;
    if (rows[from]!.time - before.time - before.duration > SAME_CUT_S) break;
  }
  return [from, to];
}

/** The last rows of [from, to), on a way of at most `length` mm. */
export function lastOf(rows: readonly Row[], [from, to]: [number, number], length: number): [number, number] {
  let way = 0;
  for (let n = to - 1; n > from; --n) {
    const [a, b] = [rows[n - 1]!.tip, rows[n]!.tip];
    way += Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    if (way > length) return [n, to];
  }
  return [from, to];
}

export class Pass {
  readonly group = new Group();
  private readonly lines = new PathLines();
  private readonly curtain = new Curtain();
  private rows: Row[] = [];
  private size = 1;
  private time = 0;
  private at: [number, number] = [0, 0];
  private now: PassShown = "pass";
  // Share of its height at which the curtain stands.
  private standing = 1;

  constructor() {
    this.group.add(this.lines.group, this.curtain.mesh);
  }

  begin(size: number): void {
    this.size = size;
    this.lines.begin();
    this.forgetRows();
  }
  forgetRows(): void {
    this.rows = [];
    this.at = [0, 0];
    this.lines.forgetRows();
    this.curtain.hide();
  }

  takePath(frame: PathFrame): void {
    this.lines.take(frame);
    this.choose();
  }

  add(rows: Row[], map: HeatMap, colouring: Colouring): void {
    for (const row of rows) this.rows.push(row);
    this.lines.add(rows, (row) => map.ofRow(colouring, row), map.largestForce);
    this.show(this.time, map, colouring);
  }
  recolour(map: HeatMap, colouring: Colouring): void {
    this.lines.recolour((row) => map.ofRow(colouring, row));
    this.show(this.time, map, colouring);
  }
  recolourFrom(first: number): void {
    this.lines.recolourFrom(first);
  }

  show(time: number, map: HeatMap, colouring: Colouring): void {
    this.time = time;
    this.at = lastOf(this.rows, passAt(this.rows, time), LONGEST * this.size);
    this.choose();
    if (this.now === "none") return;
    const rows = this.rows.slice(...this.at);
    const share = (row: Row) => (this.standing * row.peakForce) / map.largestForce;
    this.curtain.show(rows, HEIGHT * this.size, share, (row) => map.ofRow(colouring, row));
  }

  /** The curtain stands at a share of its height. */
  stand(share: number, map: HeatMap, colouring: Colouring): void {
    this.standing = share;
    this.show(this.time, map, colouring);
  }

  set shown(shown: PassShown) {
    this.now = shown;
    this.choose();
  }

  private choose(): void {
    this.group.visible = this.now !== "none";
    this.lines.show(this.now === "all" ? [0, this.rows.length] : this.at, this.now === "all");
  }
}

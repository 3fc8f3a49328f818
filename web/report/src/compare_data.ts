// SPDX-License-Identifier: MIT
// The data that the program writes into the page of a comparison (src/report/compare/compare_page.cpp).

import type { Vec3 } from "@tribo/protocol/vec3";
import { element } from "@tribo/ui/dom";
import type { Part } from "./data.js";

type Column = (number | null)[];

/** One run: each list has one number per step of the comparison, null where the run does not cut. */
export interface Side {
  t: Column;
  line: Column;
  x: Column;
  y: Column;
  z: Column;
  /** One list per lane; null also where the value is not known. */
  values: Column[];
  part?: Part;
}

export interface Lane {
  name: string;
  unit: string;
}

interface CompareData {
  schema: "tribo.compare-page/1";
  /** The common axis, with its unit. */
  axis: string;
  lanes: Lane[];
  /** Start and width of each step on it. */
  at: number[];
  width: number[];
  a: Side;
  b: Side;
  /** What the page says, in another language than English. */
  words?: Record<string, string>;
}

export const data = JSON.parse(element("data").textContent ?? "") as CompareData;
export const count = data.at.length;
export const SIDES = ["a", "b"] as const;
export type SideName = (typeof SIDES)[number];

export function tipAt(side: Side, step: number): Vec3 | undefined {
  const x = side.x[step];
  return x === null || x === undefined ? undefined : [x, side.y[step]!, side.z[step]!];
}

/** B minus A; null where one of them is not known. */
export function differenceAt(lane: number, step: number): number | null {
  const a = data.a.values[lane]![step] ?? null;
  const b = data.b.values[lane]![step] ?? null;
  return a === null || b === null ? null : b - a;
}

/** In the language of the page. `{name}` in the text is the value of that name. */
export function say(text: string, values: Record<string, string | number> = {}): string {
  return (data.words?.[text] ?? text).replace(/\{(\w+)\}/g, (_, name: string) => String(values[name]));
}

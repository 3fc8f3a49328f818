// SPDX-License-Identifier: MIT
// The box of the stock as a job has it, [[x, y, z], [x, y, z]] in mm, and how a face of it is moved.

import { vec3, type Vec3 } from "@tribo/protocol/vec3";

export type Box = readonly [Vec3, Vec3];

/** A face: 0 the low one, 1 the high one, and its axis. */
export interface Face {
  end: 0 | 1;
  axis: 0 | 1 | 2;
}
export const FACES: readonly Face[] = ([0, 1] as const).flatMap((end) =>
  ([0, 1, 2] as const).map((axis) => ({ end, axis })),
);

const TEXT = /^\[\s*\[([^[\]]*)\]\s*,\s*\[([^[\]]*)\]\s*\]$/;

/** Undefined: the text is no box of numbers. */
export function boxOf(text: string): Box | undefined {
  const ends = (TEXT.exec(text) ?? [])
    .slice(1)
    .map((end) => end.split(",").map((v) => Number(v.trim().replaceAll("_", "") || Number.NaN)));
  const [low, high] = ends;
  if (low?.length !== 3 || high?.length !== 3 || ![...low, ...high].every(Number.isFinite)) return undefined;
  return [vec3((k) => low[k]!), vec3((k) => high[k]!)];
}
export function textOf([low, high]: Box): string {
  return `[[${low.join(", ")}], [${high.join(", ")}]]`;
}

export function middleOf([low, high]: Box, { end, axis }: Face): Vec3 {
  return vec3((k) => (k === axis ? [low, high][end]![k] : (low[k] + high[k]) / 2));
}

/** The box with a face at `to`, but at least `least` thick. */
export function moved(box: Box, { end, axis }: Face, to: number, least: number): Box {
  const other = box[1 - end]![axis];
  const at = end === 0 ? Math.min(to, other - least) : Math.max(to, other + least);
  const ends = box.map((corner, n) => vec3((k) => (n === end && k === axis ? at : corner[k])));
  return [ends[0]!, ends[1]!];
}

/** The round step for a length, a power of ten: a part in 100 to 1000 of it. */
export function stepFor(length: number): number {
  return 10 ** Math.floor(Math.log10(length / 100));
}

/**
 * Where a ray comes nearest to the line through `point` along an axis: the coordinate there. Undefined: it looks almost
 * along the axis.
 */
export function nearestOnAxis(origin: Vec3, direction: Vec3, point: Vec3, axis: 0 | 1 | 2): number | undefined {
  // The line is point + s e, the ray origin + r d with |d| = 1: both differences are normal to their connection.
  const along = direction[axis];
  const across = 1 - along * along;
  if (across < 1e-3) return undefined;
  const from = vec3((k) => origin[k] - point[k]);
  const onRay = from[0] * direction[0] + from[1] * direction[1] + from[2] * direction[2];
  return point[axis] + (from[axis] - along * onRay) / across;
}

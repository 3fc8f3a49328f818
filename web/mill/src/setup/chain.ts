// SPDX-License-Identifier: MIT
// A chain of set-ups: each job begins with the stock that the one before leaves, clamped anew (docs/job.md).

import type { JobFile, Order } from "../sources/workshop.js";
import { entriesOf, unquoted, withKey, withoutLine } from "./job_text.js";

const lastName = (path: string) => path.slice(path.lastIndexOf("/") + 1);
export const textOf = ({ bytes }: Pick<JobFile, "bytes">) => new TextDecoder().decode(bytes);

/** The jobs of an order, the first set-up first; none for a program without a job. */
export function chainOf({ files, job }: Pick<Order, "files" | "job">): JobFile[] {
  const chain: JobFile[] = [];
  let file = files.find(({ name }) => name === job && /\.toml$/i.test(name));
  while (file && !chain.includes(file)) {
    chain.unshift(file);
    const from = entriesOf(textOf(file)).find(({ table, key }) => table === "stock" && key === "from");
    const before = from && unquoted(from.raw);
    file = before === undefined ? undefined : files.find(({ name }) => lastName(name) === lastName(before));
  }
  return chain;
}

/** How a job stands in the stock of the earlier one. "other": its axes are none of these. */
export type Clamping = "same" | "over x" | "over y" | "other";
const UP = "[0, 0, 1]";
const DOWN = "[0, 0, -1]";
const RIGHT = "[1, 0, 0]";
const LEFT = "[-1, 0, 0]";

const keyOf = (text: string, name: string) =>
  entriesOf(text).find(({ table, key }) => table === "setup" && key === name);
// Any length: its direction along an axis, or undefined.
function along(raw: string | undefined, otherwise: string): string | undefined {
  const numbers = (raw ?? otherwise)
    .replace(/[[\]\s_]/g, "")
    .split(",")
    .map(Number);
  const signs = numbers.map(Math.sign);
  return signs.filter((sign) => sign !== 0).length === 1 ? `[${signs.join(", ")}]` : undefined;
}

export function clampingOf(text: string): Clamping {
  const z = along(keyOf(text, "z_axis")?.raw, UP);
  const x = along(keyOf(text, "x_axis")?.raw, RIGHT);
  if (z === UP && x === RIGHT) return "same";
  if (z === DOWN && x === RIGHT) return "over x";
  if (z === DOWN && x === LEFT) return "over y";
  return "other";
}

export function withClamping(text: string, wanted: Clamping): string {
  if (wanted === "other") return text;
  const set = (to: string, name: string, raw: string, otherwise: string) => {
    const entry = keyOf(to, name);
    if (raw !== otherwise) return withKey(to, "setup", name, raw);
    return entry ? withoutLine(to, entry.line) : to;
  };
  const turned = set(text, "z_axis", wanted === "same" ? UP : DOWN, UP);
  return set(turned, "x_axis", wanted === "over y" ? LEFT : RIGHT, RIGHT);
}

/** This job's zero in the coordinates of the earlier one, mm; undefined: it is not three numbers in one line. */
export function zeroOf(text: string): [number, number, number] | undefined {
  const raw = keyOf(text, "origin_mm")?.raw ?? "[0, 0, 0]";
  const numbers = raw
    .replace(/[[\]\s_]/g, "")
    .split(",")
    .map(Number);
  return numbers.length === 3 && numbers.every(Number.isFinite) ? (numbers as [number, number, number]) : undefined;
}
export function withZero(text: string, zero: readonly number[]): string {
  return withKey(text, "setup", "origin_mm", `[${zero.join(", ")}]`);
}

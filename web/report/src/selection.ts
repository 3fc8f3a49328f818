// SPDX-License-Identifier: MIT
// The selected row, shared by all plots and the part.

import { element } from "@tribo/ui/dom";
import { count, rows } from "./data.js";
import { short } from "./numbers.js";

const slider = element<HTMLInputElement>("row");
const linked: (() => void)[] = [];

/** Index of the row, or -1. */
export let selected = -1;

/** `redraw` is called when another row is selected. */
export function follow(redraw: () => void): void {
  linked.push(redraw);
}

function vibrates(i: number): string {
  const growth = rows.mu?.[i];
  if (!growth) return "";
  return `; a vibration grows by <b>${short(growth)}</b>, the tool moves by ${short(rows.move?.[i] ?? 0)} mm`;
}

export function select(i: number): void {
  if (i === selected || i < 0 || i >= count) return;
  selected = i;
  slider.value = String(i);
  const s = (list: number[]) => short(list[i]!);
  element("readout").innerHTML =
    `line <b>${rows.line[i]}</b> at <b>${s(rows.t)} s</b>, tip (${s(rows.x)}, ${s(rows.y)}, ${s(rows.z)}) mm:` +
    ` peak <b>${s(rows.peak)} N</b> (${s(rows.low)} to ${s(rows.high)}), mean <b>${s(rows.mean)} N</b>;` +
    ` engaged ${s(rows.entry)}° to ${s(rows.exit)}°, ${s(rows.depth)} mm deep, ${s(rows.rpm)} rpm, ${s(rows.feed)} mm/min${vibrates(i)}`;
  for (const redraw of linked) redraw();
}

/** Returns the last row that begins at or before a time. */
export function rowAt(t: number): number {
  let low = 0;
  let high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (rows.t[middle]! <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

export function listenToSlider(): void {
  slider.max = String(count - 1);
  slider.addEventListener("input", () => select(Number(slider.value)));
}

/** Returns the runs of rows without a gap as [first, end) pairs. */
export const runs: [first: number, end: number][] = [];
for (let i = 0, first = 0; i < count; ++i) {
  if (i + 1 === count || rows.t[i + 1]! > rows.t[i]! + 1.5 * rows.dt[i]! + 1e-6) {
    runs.push([first, i + 1]);
    first = i + 1;
  }
}

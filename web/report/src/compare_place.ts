// SPDX-License-Identifier: MIT
// The place in the cut that views, plots and readouts share, and the clock that moves it.

import { element } from "@tribo/ui/dom";
import { count, data, say, type SideName } from "./compare_data.js";
import { clamp, short } from "./numbers.js";

/** The whole cut plays in this time, s. */
const PLAYS_S = 20;

const slider = element<HTMLInputElement>("place");
const button = element<HTMLButtonElement>("play");
const linked: (() => void)[] = [];

/** The step. */
export let place = 0;

export function follow(changed: () => void): void {
  linked.push(changed);
}

export function goTo(step: number): void {
  place = clamp(Math.round(step), 0, count - 1);
  slider.value = String(place);
  for (const changed of linked) changed();
}

/** The step that holds a place of the axis. */
export function stepAt(at: number): number {
  let low = 0;
  let high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (data.at[middle]! <= at) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** With the decimal sign of the page. */
export const said = (value: number) => short(value).replace(".", say("."));

/** What a run does there, in words. */
export function wordsAt(side: SideName, step: number): string {
  const run = data[side];
  if (run.t[step] === null) return say("cuts nothing here");
  const known = data.lanes
    .map((lane, n) => [lane, run.values[n]![step]] as const)
    .filter(([, value]) => value !== null && value !== undefined)
    .map(([lane, value]) => `${lane.name} ${said(value!)}${lane.unit && ` ${lane.unit}`}`);
  const values = known.join(", ");
  return say("line {line} at {time} s: {values}", { line: run.line[step]!, time: said(run.t[step]!), values });
}

let playing = 0;

function stop(): void {
  cancelAnimationFrame(playing);
  playing = 0;
  button.textContent = say("Play");
}

function play(): void {
  const first = data.at[0]!;
  const all = data.at[count - 1]! + data.width[count - 1]! - first;
  let at = place === count - 1 ? first : data.at[place]!;
  let last = performance.now();
  button.textContent = say("Pause");
  const tick = (now: number) => {
    at += (all * (now - last)) / (1000 * PLAYS_S);
    last = now;
    goTo(stepAt(at));
    if (at >= first + all) stop();
    else playing = requestAnimationFrame(tick);
  };
  playing = requestAnimationFrame(tick);
}

export function listenToClock(): void {
  slider.max = String(count - 1);
  slider.addEventListener("input", () => {
    stop();
    goTo(Number(slider.value));
  });
  button.addEventListener("click", () => (playing ? stop() : play()));
}

// SPDX-License-Identifier: MIT

export { clamp } from "@tribo/ui/clamp";
export const largest = (list: number[]) => list.reduce((m, v) => Math.max(m, v), 0);

/** Rounds to significant digits, without exponents for numbers of usual size. */
export function short(v: number, digits = 3): string {
  const size = Math.abs(v);
  if (size >= 1e6 || (size > 0 && size < 1e-3)) return v.toExponential(2);
  return String(Number(v.toPrecision(digits)));
}

/** Returns round steps, so that four to nine ticks cover the range. */
export function ticks(low: number, high: number, wanted: number): number[] {
  const raw = (high - low) / wanted;
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * (raw > 5 * power ? 10 : raw > 2 * power ? 5 : raw > power ? 2 : 1);
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) found.push(i * step);
  return found;
}

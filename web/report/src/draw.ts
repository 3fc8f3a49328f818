// SPDX-License-Identifier: MIT
// Common drawing functions of the plots.

import type { Plot } from "./plot.js";

export type Context = CanvasRenderingContext2D;

/** Returns a colour of the style sheet for the current colour scheme. */
export const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export function line(c: Context, x0: number, y0: number, x1: number, y1: number): void {
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  c.stroke();
}

export function curve(
  c: Context,
  plot: Plot,
  xs: (i: number) => number,
  ys: number[],
  colour: string,
  width = 1.4,
): void {
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.lineJoin = "round";
  c.beginPath();
  ys.forEach((y, i) => c.lineTo(plot.x(xs(i)), plot.y(y)));
  c.stroke();
}

export function legend(c: Context, plot: Plot, entries: [text: string, colour: string][]): void {
  c.textAlign = "left";
  c.textBaseline = "middle";
  let x = plot.left + 10;
  for (const [text, colour] of entries) {
    c.fillStyle = colour;
    c.fillRect(x, plot.top + 9, 14, 3);
    c.fillStyle = css("--soft");
    c.fillText(text, x + 19, plot.top + 11);
    x += 34 + c.measureText(text).width;
  }
}

// SPDX-License-Identifier: MIT
// A canvas with axes.

import { fitToScreen } from "@tribo/ui/canvas";
import { element } from "@tribo/ui/dom";
import { css, line, type Context } from "./draw.js";
import { clamp, short, ticks } from "./numbers.js";

// Ticks are round numbers, but many of them may lie between others.
const TICK_DIGITS = 6;

type Range = [low: number, high: number];

export interface PlotOptions {
  xLabel: string;
  yLabel: string;
  /** Margin at the right side, in CSS pixels. */
  right?: number;
  /** Ranges of the axes; `aspect` is width over height of the frame. */
  extent(aspect: number): { x: Range; y: Range };
  /** Draws inside the frame. The picture is kept, so that moving a cursor needs no redrawing of it. */
  paint(c: Context): void;
  cursor?(c: Context): void;
}

export class Plot {
  readonly top = 14;
  readonly left = 58;
  readonly canvas: HTMLCanvasElement;
  readonly #context: Context;
  readonly #kept = document.createElement("canvas");
  readonly #options: PlotOptions;
  #range: { x: Range; y: Range } | undefined;

  constructor(id: string, options: PlotOptions) {
    this.#options = options;
    this.canvas = element<HTMLCanvasElement>(id);
    this.#context = this.canvas.getContext("2d")!;
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement!);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  // The frame, in CSS pixels, and positions in it.
  get width(): number {
    return this.canvas.clientWidth - this.left - (this.#options.right ?? 16);
  }
  get height(): number {
    return this.canvas.clientHeight - this.top - 34;
  }
  x(v: number): number {
    const [low, high] = this.#range!.x;
    return this.left + ((v - low) / (high - low)) * this.width;
  }
  y(v: number): number {
    const [low, high] = this.#range!.y;
    return this.top + (1 - (v - low) / (high - low)) * this.height;
  }
  fromX(px: number): number {
    const [low, high] = this.#range!.x;
    return low + ((px - this.left) / this.width) * (high - low);
  }

  draw(): void {
    const { canvas } = this;
    const c = this.#context;
    const kept = this.#kept;
    if (canvas.clientWidth < 80 || canvas.clientHeight < 60) return;
    const ratio = fitToScreen(canvas);
    this.#range = this.#options.extent(this.width / this.height);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    this.#axes(c);
    c.save();
    c.beginPath();
    c.rect(this.left, this.top, this.width, this.height);
    c.clip();
    this.#options.paint(c);
    c.restore();
    kept.width = canvas.width;
    kept.height = canvas.height;
    kept.getContext("2d")!.drawImage(canvas, 0, 0);
    this.overlay();
  }

  /** Draws the cursor again. */
  overlay(): void {
    const c = this.#context;
    const kept = this.#kept;
    if (!this.#range) return;
    c.save();
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, kept.width, kept.height);
    c.drawImage(kept, 0, 0);
    c.restore();
    this.#options.cursor?.(c);
  }

  #axes(c: Context): void {
    const { top, left } = this;
    const right = left + this.width;
    const bottom = top + this.height;
    c.font = "12px system-ui, sans-serif";
    c.lineWidth = 1;
    c.strokeStyle = css("--grid");
    c.fillStyle = css("--soft");
    c.textAlign = "center";
    c.textBaseline = "top";
    for (const v of ticks(...this.#range!.x, clamp(this.width / 90, 2, 9))) {
      line(c, this.x(v), top, this.x(v), bottom);
      c.fillText(short(v, TICK_DIGITS), this.x(v), bottom + 5);
    }
    c.textAlign = "right";
    c.textBaseline = "middle";
    for (const v of ticks(...this.#range!.y, clamp(this.height / 44, 2, 8))) {
      line(c, left, this.y(v), right, this.y(v));
      c.fillText(short(v, TICK_DIGITS), left - 7, this.y(v));
    }
    c.textBaseline = "bottom";
    c.fillText(this.#options.xLabel, right, bottom + 33);
    c.save();
    c.translate(13, top);
    c.rotate(-Math.PI / 2);
    c.textBaseline = "middle";
    c.fillText(this.#options.yLabel, 0, 0);
    c.restore();
  }
}

// SPDX-License-Identifier: MIT
// Peak force over the program as columns, one per pixel: an overview, and a place to click.

import type { Row } from "@tribo/protocol/frames";
import { fitToScreen } from "@tribo/ui/canvas";

export class Plot {
  private duration = 1;
  private largest = 1;
  private columns = new Float32Array(0);
  private rows: Row[] = [];
  private time = 0;
  private wanted = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    seek: (time: number) => void,
  ) {
    canvas.addEventListener("click", (event) => seek((event.offsetX / canvas.clientWidth) * this.duration));
    new ResizeObserver(() => this.lay()).observe(canvas);
  }

  begin(duration: number): void {
    this.duration = Math.max(duration, 1e-9);
    this.rows = [];
    this.largest = 1;
    this.lay();
  }

  addRows(rows: Row[]): void {
    this.rows.push(...rows);
    for (const row of rows) this.addRow(row);
    this.draw();
  }

  setTime(time: number): void {
    this.time = time;
    this.draw();
  }

  private lay(): void {
    fitToScreen(this.canvas, 2);
    this.columns = new Float32Array(this.canvas.width);
    for (const row of this.rows) this.addRow(row);
    this.draw();
  }

  private addRow(row: Row): void {
    const scale = this.columns.length / this.duration;
    const from = Math.floor(row.time * scale);
    const to = Math.min(Math.floor((row.time + row.duration) * scale), this.columns.length - 1);
    for (let x = from; x <= to; ++x) this.columns[x] = Math.max(this.columns[x]!, row.peakForce);
    this.largest = Math.max(this.largest, row.peakForce);
  }

  private draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      const context = this.canvas.getContext("2d");
      if (!context) return;
      const { width, height } = this.canvas;
      const style = getComputedStyle(this.canvas);
      context.clearRect(0, 0, width, height);
      context.fillStyle = style.getPropertyValue("--accent");
      const ratio = height / Math.max(this.canvas.clientHeight, 1);
      // Behind the text.
      const scale = (height - 14 * ratio) / this.largest;
      this.columns.forEach((force, x) => context.fillRect(x, height - force * scale, 1, force * scale));
      context.fillStyle = style.getPropertyValue("--quiet");
      context.font = `${Math.round(11 * ratio)}px system-ui, sans-serif`;
      if (this.rows.length > 0)
        context.fillText(`peak force, largest ${this.largest.toFixed(0)} N`, 4 * ratio, 11 * ratio);
      context.fillStyle = style.getPropertyValue("--ink");
      context.fillRect((this.time / this.duration) * width - 1, 0, 2, height);
    });
  }
}

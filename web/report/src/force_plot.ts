// SPDX-License-Identifier: MIT
// Force over time, with the uncertainty band of the largest force. Drag to zoom, double-click to see all again.

import { count, rows } from "./data.js";
import { css, curve, legend, line } from "./draw.js";
import { clamp } from "./numbers.js";
import { Plot } from "./plot.js";
import { follow, rowAt, runs, select, selected } from "./selection.js";

// A shorter movement of the mouse is a click, pixels.
const LEAST_DRAG = 6;

export function forcePlot(): void {
  const all: [number, number] = [rows.t[0]!, rows.t[count - 1]! + rows.dt[count - 1]!];
  let shown = all;
  let drag: [from: number, to: number] | undefined;
  const plot = new Plot("force-plot", {
    xLabel: "time, s",
    yLabel: "force, N",
    extent() {
      const top = rows.high.reduce(
        (m, v, i) => (rows.t[i]! >= shown[0] && rows.t[i]! <= shown[1] ? Math.max(m, v) : m),
        0,
      );
      return { x: shown, y: [0, 1.06 * top || 1] };
    },
    paint(c) {
      for (const [first, end] of runs) {
        c.fillStyle = css("--peak");
        c.globalAlpha = 0.14;
        c.beginPath();
        for (let i = first; i < end; ++i) c.lineTo(plot.x(rows.t[i]!), plot.y(rows.high[i]!));
        for (let i = end; i-- > first;) c.lineTo(plot.x(rows.t[i]!), plot.y(rows.low[i]!));
        c.fill();
        c.globalAlpha = 1;
        const xs = (i: number) => rows.t[first + i]!;
        curve(c, plot, xs, rows.peak.slice(first, end), css("--peak"));
        curve(c, plot, xs, rows.mean.slice(first, end), css("--mean"));
      }
      legend(c, plot, [
        ["largest in a turn", css("--peak")],
        ["mean over a turn", css("--mean")],
      ]);
    },
    cursor(c) {
      c.strokeStyle = css("--cursor");
      if (selected >= 0) {
        const x = plot.x(rows.t[selected]!);
        line(c, x, plot.top, x, plot.top + plot.height);
      }
      if (!drag) return;
      c.fillStyle = css("--accent");
      c.globalAlpha = 0.18;
      c.fillRect(drag[0], plot.top, drag[1] - drag[0], plot.height);
      c.globalAlpha = 1;
    },
  });
  const { canvas } = plot;
  canvas.addEventListener("pointermove", (e) => {
    if (drag) drag[1] = e.offsetX;
    select(rowAt(plot.fromX(e.offsetX)));
    if (drag) plot.overlay();
  });
  canvas.addEventListener("pointerdown", (e) => {
    if (e.pointerType === "mouse") drag = [e.offsetX, e.offsetX];
  });
  window.addEventListener("pointerup", () => {
    if (!drag) return;
    const [from, to] = drag.sort((p, q) => p - q);
    drag = undefined;
    if (to - from > LEAST_DRAG) {
      shown = [clamp(plot.fromX(from), ...all), clamp(plot.fromX(to), ...all)];
      plot.draw();
    } else {
      plot.overlay();
    }
  });
  canvas.addEventListener("dblclick", () => {
    shown = all;
    plot.draw();
  });
  follow(() => plot.overlay());
}

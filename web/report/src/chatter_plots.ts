// SPDX-License-Identifier: MIT
// By how much a vibration grows along the program, and the vibration of the worst cut in time.

import { count, rows, type Vibration } from "./data.js";
import { css, curve, legend, line } from "./draw.js";
import { largest } from "./numbers.js";
import { Plot } from "./plot.js";
import { follow, rowAt, runs, select, selected } from "./selection.js";

export function chatterPlot(mu: number[]): void {
  const plot = new Plot("chatter-plot", {
    xLabel: "time, s",
    yLabel: "growth",
    extent: () => ({
      x: [rows.t[0]!, rows.t[count - 1]! + rows.dt[count - 1]!],
      y: [0, Math.max(1.25, 1.06 * largest(mu))],
    }),
    paint(c) {
      c.strokeStyle = css("--cursor");
      c.setLineDash([6, 4]);
      line(c, plot.left, plot.y(1), plot.left + plot.width, plot.y(1));
      c.setLineDash([]);
      // A run ends where a multiplier is unknown.
      for (const [first, end] of runs) {
        for (let i = first; i < end; ++i) {
          if (mu[i] === 0) continue;
          const next = i + 1 < end && mu[i + 1] !== 0 ? i + 1 : i;
          c.strokeStyle = css(mu[i]! > 1 ? "--peak" : "--mean");
          c.lineWidth = 1.6;
          const to = next > i ? rows.t[next]! : rows.t[i]! + rows.dt[i]!;
          line(c, plot.x(rows.t[i]!), plot.y(mu[i]!), plot.x(to), plot.y(mu[next]!));
        }
      }
      legend(c, plot, [
        ["chatters", css("--peak")],
        ["stable", css("--mean")],
      ]);
    },
    cursor(c) {
      if (selected < 0) return;
      const x = plot.x(rows.t[selected]!);
      c.strokeStyle = css("--cursor");
      line(c, x, plot.top, x, plot.top + plot.height);
    },
  });
  plot.canvas.addEventListener("pointermove", (e) => select(rowAt(plot.fromX(e.offsetX))));
  follow(() => plot.overlay());
}

export function vibrationPlot({ rate, x, y }: Vibration): void {
  const top = largest([...x, ...y].map(Math.abs)) || 1;
  const ms = (i: number) => (1000 * i) / rate;
  const plot = new Plot("vibration-plot", {
    xLabel: "time, ms",
    yLabel: "mm",
    extent: () => ({ x: [0, ms(x.length)], y: [-1.08 * top, 1.08 * top] }),
    paint(c) {
      curve(c, plot, ms, y, css("--peak"), 1);
      curve(c, plot, ms, x, css("--accent"), 1);
      legend(c, plot, [
        ["along the feed", css("--accent")],
        ["across it", css("--peak")],
      ]);
    },
  });
}

// SPDX-License-Identifier: MIT
// The tool path from above, coloured by a chosen value.

import type { Vec3 } from "@tribo/protocol/vec3";
import { between } from "@tribo/ui/colours";
import { element } from "@tribo/ui/dom";
import { count, rows } from "./data.js";
import { css, line } from "./draw.js";
import { largest, short } from "./numbers.js";
import { Plot } from "./plot.js";
import { follow, runs, select, selected } from "./selection.js";

const SCALE: Vec3[] = [
  [37, 99, 180],
  [32, 150, 140],
  [226, 160, 30],
  [200, 45, 30],
];
const UNITS = { peak: "N", mean: "N", depth: "mm", feed: "mm/min", mu: "growth" };
// A pointer selects a row within this distance, in pixels.
const REACH = 30;

const colour = (share: number) => `rgb(${between(SCALE, share).map(Math.round).join()})`;

/** Centre and width of the range of a list. */
function span(list: number[]): { middle: number; width: number } {
  const low = list.reduce((m, v) => Math.min(m, v), Infinity);
  const high = list.reduce((m, v) => Math.max(m, v), -Infinity);
  return { middle: 0.5 * (low + high), width: high - low };
}

export function pathPlot(): void {
  let by: keyof typeof UNITS = "peak";
  const value = (i: number) => rows[by]?.[i] ?? 0;
  const most = () => largest(rows[by] ?? []) || 1;
  if (rows.mu) document.querySelector("#colouring [hidden]")?.removeAttribute("hidden");
  const x = span(rows.x);
  const y = span(rows.y);
  const plot = new Plot("path-plot", {
    xLabel: "x, mm",
    yLabel: "y, mm",
    right: 92,
    extent(aspect) {
      // The scale is equal in both directions.
      const half = 0.54 * Math.max(y.width, x.width / aspect, 1e-3);
      return { x: [x.middle - half * aspect, x.middle + half * aspect], y: [y.middle - half, y.middle + half] };
    },
    paint(c) {
      const top = most();
      c.lineCap = "round";
      c.lineWidth = 2;
      for (const [first, end] of runs) {
        for (let i = first; i < end; ++i) {
          const next = Math.min(i + 1, end - 1);
          c.strokeStyle = colour(value(i) / top);
          line(c, plot.x(rows.x[i]!), plot.y(rows.y[i]!), plot.x(rows.x[next]!), plot.y(rows.y[next]!));
        }
      }
    },
    cursor(c) {
      const left = plot.left + plot.width + 14;
      const h = Math.min(plot.height, 220);
      for (let i = 0; i < h; ++i) {
        c.fillStyle = colour(1 - i / h);
        c.fillRect(left, plot.top + i, 12, 1.5);
      }
      c.fillStyle = css("--soft");
      c.textAlign = "left";
      c.textBaseline = "middle";
      for (const share of [0, 0.5, 1])
        c.fillText(short(share * most()), left + 17, plot.top + 6 + (1 - share) * (h - 12));
      c.fillText(UNITS[by], left, plot.top + h + 14);
      if (selected < 0) return;
      c.strokeStyle = css("--cursor");
      c.lineWidth = 2;
      c.beginPath();
      c.arc(plot.x(rows.x[selected]!), plot.y(rows.y[selected]!), 6, 0, 2 * Math.PI);
      c.stroke();
    },
  });
  plot.canvas.addEventListener("pointermove", (e) => {
    let best = -1;
    let least = REACH * REACH;
    for (let i = 0; i < count; ++i) {
      const d = (plot.x(rows.x[i]!) - e.offsetX) ** 2 + (plot.y(rows.y[i]!) - e.offsetY) ** 2;
      if (d < least) {
        least = d;
        best = i;
      }
    }
    select(best);
  });
  element("colouring").addEventListener("change", (e) => {
    by = (e.target as HTMLInputElement).value as keyof typeof UNITS;
    plot.draw();
  });
  follow(() => plot.overlay());
}

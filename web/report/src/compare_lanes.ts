// SPDX-License-Identifier: MIT
// A value of both runs along the cut, and below it the difference. Both plots show the same stretch.

import { element } from "@tribo/ui/dom";
import { count, data, differenceAt, type Side } from "./compare_data.js";
import { follow, goTo, place, stepAt } from "./compare_place.js";
import { css, legend, line, type Context } from "./draw.js";
import { Plot } from "./plot.js";

let lane = 0;

/** Draws the values as steps, with gaps where they are null. */
function stairs(c: Context, plot: Plot, value: (step: number) => number | null, colour: string): void {
  c.strokeStyle = colour;
  c.lineWidth = 1.4;
  c.beginPath();
  let open = false;
  for (let n = 0; n < count; ++n) {
    const v = value(n);
    const left = data.at[n]!;
    if (v === null) {
      open = false;
      continue;
    }
    const joins = open && left <= data.at[n - 1]! + 1.5 * data.width[n - 1]!;
    if (joins) c.lineTo(plot.x(left), plot.y(v));
    else c.moveTo(plot.x(left), plot.y(v));
    c.lineTo(plot.x(left + data.width[n]!), plot.y(v));
    open = true;
  }
  c.stroke();
}

const values = (of: Side) => (step: number) => of.values[lane]![step] ?? null;

function rangeOf(lists: ((step: number) => number | null)[]): [low: number, high: number] {
  let low = 0;
  let high = 0;
  for (const list of lists)
    for (let n = 0; n < count; ++n) {
      low = Math.min(low, list(n) ?? 0);
      high = Math.max(high, list(n) ?? 0);
    }
  const room = 0.06 * (high - low) || 1;
  return [low < 0 ? low - room : 0, high > 0 || low === 0 ? high + room : 0];
}

export function lanePlots(): void {
  const all: [number, number] = [data.at[0]!, data.at[count - 1]! + data.width[count - 1]!];
  const label = () => {
    const { name, unit } = data.lanes[lane]!;
    return unit ? `${name}, ${unit}` : name;
  };
  const cursor = (plot: Plot) => (c: Context) => {
    c.strokeStyle = css("--cursor");
    const x = plot.x(data.at[place]! + 0.5 * data.width[place]!);
    line(c, x, plot.top, x, plot.top + plot.height);
  };
  const both: Plot = new Plot("lane-plot", {
    xLabel: data.axis,
    get yLabel() {
      return label();
    },
    extent: () => ({ x: all, y: rangeOf([values(data.a), values(data.b)]) }),
    paint(c) {
      stairs(c, both, values(data.a), css("--mean"));
      stairs(c, both, values(data.b), css("--peak"));
      legend(c, both, [
        ["A", css("--mean")],
        ["B", css("--peak")],
      ]);
    },
    cursor: (c) => cursor(both)(c),
  });
  const difference = (step: number) => differenceAt(lane, step);
  const below: Plot = new Plot("difference-plot", {
    xLabel: data.axis,
    yLabel: "B − A",
    extent: () => ({ x: all, y: rangeOf([difference]) }),
    paint(c) {
      c.strokeStyle = css("--soft");
      c.lineWidth = 1;
      line(c, below.left, below.y(0), below.left + below.width, below.y(0));
      stairs(c, below, difference, css("--z"));
    },
    cursor: (c) => cursor(below)(c),
  });
  for (const plot of [both, below]) {
    const point = (e: PointerEvent) => goTo(stepAt(plot.fromX(e.offsetX)));
    plot.canvas.addEventListener("pointerdown", point);
    plot.canvas.addEventListener("pointermove", (e) => e.buttons && point(e));
    follow(() => plot.overlay());
  }
  element("lane-choice").addEventListener("change", (e) => {
    lane = Number((e.target as HTMLInputElement).value);
    both.draw();
    below.draw();
  });
}

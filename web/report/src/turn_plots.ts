// SPDX-License-Identifier: MIT
// One turn of the spindle at the largest force, and its spectrum.

import { element } from "@tribo/ui/dom";
import type { Turn } from "./data.js";
import { css, curve, legend, line } from "./draw.js";
import { clamp, largest, short } from "./numbers.js";
import { Plot } from "./plot.js";

const AXES = ["x", "y", "z"] as const;

export function turnPlots(turn: Turn): void {
  element("turn-hint").textContent =
    `Line ${turn.line} at ${short(turn.t)} s, ${short(turn.rpm)} rpm: one turn takes ${short(60000 / turn.rpm)} ms.`;
  const all = [...turn.x, ...turn.y, ...turn.z];
  const low = Math.min(0, ...all);
  const high = Math.max(0, ...all);
  const room = 0.08 * (high - low || 1);
  const plot = new Plot("turn-plot", {
    xLabel: "spindle angle, degrees",
    yLabel: "force, N",
    extent: () => ({ x: [0, 360], y: [low - room, high + 2 * room] }),
    paint(c) {
      const angle = (i: number) => (360 * i) / turn.x.length;
      for (const axis of AXES) curve(c, plot, angle, [...turn[axis], turn[axis][0]!], css(`--${axis}`), 1.8);
      legend(
        c,
        plot,
        AXES.map((axis) => [`F${axis}`, css(`--${axis}`)]),
      );
    },
  });
  const highest = turn.hz.at(-1) || 1;
  const spectrum = new Plot("spectrum-plot", {
    xLabel: "frequency, Hz",
    yLabel: "amplitude, N",
    extent: () => ({ x: [-0.03 * highest, 1.05 * highest], y: [0, 1.1 * largest(turn.amplitude) || 1] }),
    paint(c) {
      c.strokeStyle = css("--accent");
      c.lineWidth = clamp((0.5 * spectrum.width) / turn.hz.length, 1.5, 14);
      turn.hz.forEach((hz, i) =>
        line(c, spectrum.x(hz), spectrum.y(0), spectrum.x(hz), spectrum.y(turn.amplitude[i]!)),
      );
    },
  });
}

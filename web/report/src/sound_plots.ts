// SPDX-License-Identifier: MIT
// The envelope of the whole sound, which controls the player, and the waveform of a few milliseconds.

import { element } from "@tribo/ui/dom";
import { count, type Envelope, type Wave } from "./data.js";
import { css, curve, line } from "./draw.js";
import { clamp, largest } from "./numbers.js";
import { Plot } from "./plot.js";
import { rowAt, select } from "./selection.js";

export function envelopePlot(envelope: Envelope): void {
  const audio = document.querySelector("audio");
  const top = largest([...envelope.high, ...envelope.low].map(Math.abs)) || 1;
  const plot = new Plot("envelope-plot", {
    xLabel: "time, s",
    yLabel: "Pa",
    extent: () => ({ x: [0, envelope.seconds], y: [-1.05 * top, 1.05 * top] }),
    paint(c) {
      const n = envelope.low.length;
      const x = (i: number) => plot.x(((i + 0.5) / n) * envelope.seconds);
      c.fillStyle = css("--accent");
      c.beginPath();
      for (let i = 0; i < n; ++i) c.lineTo(x(i), plot.y(envelope.high[i]!) - 0.5);
      for (let i = n; i-- > 0;) c.lineTo(x(i), plot.y(envelope.low[i]!) + 0.5);
      c.fill();
    },
    cursor(c) {
      if (!audio) return;
      const x = plot.x(envelope.heard + audio.currentTime);
      c.strokeStyle = css("--cursor");
      line(c, x, plot.top, x, plot.top + plot.height);
    },
  });
  if (!audio) return;
  plot.canvas.addEventListener("pointerdown", (e) => {
    audio.currentTime = clamp(plot.fromX(e.offsetX) - envelope.heard, 0, audio.duration || 0);
    plot.overlay();
  });
  const followPlayer = () => {
    plot.overlay();
    if (count) select(rowAt(envelope.heard + audio.currentTime));
    if (!audio.paused) requestAnimationFrame(followPlayer);
  };
  audio.addEventListener("play", followPlayer);
  audio.addEventListener("seeked", () => plot.overlay());
}

export function wavePlots(waves: Wave[]): void {
  const span = largest(waves.flatMap((wave) => wave.samples).map(Math.abs)) || 1;
  waves.forEach(({ label, rate, samples }, n) => {
    const id = `wave-${n}`;
    const figure = document.createElement("figure");
    figure.innerHTML = `<div class="plot"><canvas id="${id}" role="img"></canvas></div><figcaption></figcaption>`;
    figure.querySelector("canvas")!.setAttribute("aria-label", label);
    figure.querySelector("figcaption")!.textContent = label;
    element("waves").append(figure);
    const plot = new Plot(id, {
      xLabel: "time, ms",
      yLabel: "Pa",
      extent: () => ({ x: [0, (1000 * samples.length) / rate], y: [-1.08 * span, 1.08 * span] }),
      paint: (c) => curve(c, plot, (i) => (1000 * i) / rate, samples, css("--accent")),
    });
  });
}

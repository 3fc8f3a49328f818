// SPDX-License-Identifier: MIT
// The part of the report in 3D. Without WebGL 2 the picture stays.

import type { Part } from "./data.js";
import { bytesIn, nameScale, partScene } from "./part_scene.js";
import { element, short } from "./shared.js";
import { data, follow, rows, selected } from "./state.js";

function partView(part: Part): void {
  const figure = element("part-view");
  const picture = figure.querySelector("img")!;
  const scene = partScene(figure.querySelector("canvas")!, {
    part,
    bytes: bytesIn("part"),
    tip: () => (selected < 0 ? undefined : [rows.x[selected]!, rows.y[selected]!, rows.z[selected]!]),
    show(on) {
      picture.hidden = on;
      for (const live of figure.querySelectorAll<HTMLElement>(".live")) live.hidden = !on;
    },
  });
  if (!scene) return;
  follow(scene.redraw);
  if (part.deviation_range === undefined) return;
  const choice = figure.querySelector<HTMLElement>(".choices")!;
  const scale = figure.querySelector<HTMLElement>(".scale")!;
  nameScale(scale, short(part.deviation_range), "gouge", "left");
  choice.hidden = false;
  choice.addEventListener("change", (e) => {
    const on = (e.target as HTMLInputElement).value === "deviation";
    scale.hidden = !on;
    scene.colourBy(on);
  });
}

if (data.part) partView(data.part);

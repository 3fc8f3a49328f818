// SPDX-License-Identifier: MIT
// The page of a comparison: two parts under one camera, values along the cut, one place in both runs, two sounds.

import { element } from "@tribo/ui/dom";
import { count, data, say, SIDES, tipAt } from "./compare_data.js";
import { lanePlots } from "./compare_lanes.js";
import { follow, goTo, listenToClock, place, said, wordsAt } from "./compare_place.js";
import { abSound } from "./compare_sound.js";
import { largest } from "./numbers.js";
import type { Camera } from "./part_camera.js";
import { bytesIn, nameScale, partScene, type Scene } from "./part_scene.js";

const scenes: Scene[] = [];
const redrawAll = () => {
  for (const scene of scenes) scene.redraw();
};

function partViews(): void {
  let camera: Camera | undefined;
  for (const side of SIDES) {
    const { part } = data[side];
    if (!part) continue;
    const figure = element(`view-${side}`);
    const picture = figure.querySelector("img")!;
    const live = figure.querySelector<HTMLElement>(".live")!;
    const scene = partScene(figure.querySelector("canvas")!, {
      part,
      bytes: bytesIn(`part-${side}`),
      tip: () => tipAt(data[side], place),
      show(on) {
        picture.hidden = on;
        live.hidden = !on;
      },
      moved: redrawAll,
      camera,
    });
    if (!scene) return;
    camera ??= scene.camera;
    scenes.push(scene);
  }
  const range = data.a.part?.deviation_range ?? data.b.part?.deviation_range;
  if (range === undefined) return;
  const choice = element("part-colour");
  const scale = element("parts").querySelector<HTMLElement>(".scale")!;
  const colourBy = (on: boolean) => {
    scale.hidden = !on;
    for (const scene of scenes) scene.colourBy(on);
  };
  nameScale(scale, said(range), say("B cuts deeper"), say("B leaves more"));
  choice.hidden = false;
  choice.addEventListener("change", (e) => colourBy((e.target as HTMLInputElement).value === "deviation"));
  colourBy(true);
}

partViews();
if (count) {
  listenToClock();
  lanePlots();
  const readouts = SIDES.map((side) => element(`view-${side}`).querySelector(".readout")!);
  follow(() => {
    SIDES.forEach((side, n) => (readouts[n]!.textContent = wordsAt(side, place)));
    redrawAll();
  });
  // Where the first lane differs most, else where it is largest.
  const differences = data.at.map((_, n) => Math.abs((data.b.values[0]![n] ?? 0) - (data.a.values[0]![n] ?? 0)));
  const most = largest(differences);
  goTo(most > 0 ? differences.indexOf(most) : data.a.values[0]!.indexOf(largest(data.a.values[0]!.map((v) => v ?? 0))));
} else {
  for (const id of ["lanes", "clock"]) element(id).remove();
}
if (document.getElementById("listen")) abSound();

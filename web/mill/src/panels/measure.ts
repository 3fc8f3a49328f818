// SPDX-License-Identifier: MIT
// The distance between two places of the part.

import { vec3, type Vec3 } from "@tribo/protocol/vec3";
import { element } from "@tribo/ui/dom";
import { distance, lengthUnit } from "../texts/figures.js";
import { t } from "../texts/texts.js";
import type { Scene } from "../sight/scene.js";

export function listenToMeasure(scene: Scene): void {
  let places: Vec3[] | undefined;
  const ruler = element("measure");
  const measured = element("measured");
  ruler.addEventListener("click", () => {
    places = places ? undefined : [];
    const on = places !== undefined;
    ruler.setAttribute("aria-pressed", String(on));
    scene.canvas.classList.toggle("measuring", on);
    measured.hidden = !on;
    measured.textContent = t("Click two places on the part");
    scene.overlays.setMeasure([]);
    scene.draw();
  });
  scene.canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (!places) return;
      const hit = scene.pick(event.offsetX, event.offsetY);
      if (!hit) return;
      event.stopImmediatePropagation();
      if (places.length === 2) places = [];
      places.push(hit.point);
      scene.overlays.setMeasure(places);
      scene.draw();
      const [a, b] = places;
      if (!a || !b) return;
      const d = vec3((k) => b[k] - a[k]);
      measured.textContent = `${distance(Math.hypot(...d))} ${lengthUnit()}   (x ${distance(d[0])}, y ${distance(d[1])}, z ${distance(d[2])})`;
    },
    { capture: true },
  );
}

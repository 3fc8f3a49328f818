// SPDX-License-Identifier: MIT
// The legend of the colours of the part.

import { GROWTHS } from "./chatter_colours.js";
import { heat } from "./heat.js";
import { diverging, type Colouring, type HeatMap } from "./heat_map.js";
import { element } from "@tribo/ui/dom";
import { fixed, lengthWords, precise, preciseLength } from "../texts/figures.js";
import { t } from "../texts/texts.js";
import type { ChipLimits } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";

export function css(c: Vec3): string {
  return `rgb(${c.map((v) => Math.round(255 * v)).join(" ")})`;
}

export function showLegend(colouring: Colouring, map: HeatMap, limits: ChipLimits | undefined): void {
  const box = element("legend");
  box.hidden = colouring === "plain";
  if (colouring === "plain") return;
  element("legend-bar").hidden = colouring === "chatter";
  if (colouring === "chatter") {
    element("legend-low").textContent = element("legend-high").textContent = "";
    element("legend-marks").innerHTML = GROWTHS.map(
      ({ words, colour }) => `<i style="background:${css(colour)}"></i>${t(words)}`,
    ).join("");
    return;
  }
  const steps = Array.from({ length: 21 }, (_, n) => n / 20);
  const scale = colouring === "deviation" ? (share: number) => diverging(2 * share - 1) : heat;
  element("legend-bar").style.background =
    `linear-gradient(90deg, ${steps.map((share) => css(scale(share))).join(", ")})`;
  const full = preciseLength(map.scale.deviation, 3);
  const ends: Record<Exclude<Colouring, "plain" | "chatter">, [string, string]> = {
    force: [t("peak force 0"), `${fixed(map.largestForce, 0)} N`],
    chip: [t("chip 0"), lengthWords(map.largestChip, 3)],
    deviation: [t("gouge {length}", { length: full }), t("{length} left", { length: full })],
    scallop: ["0", t("{length} above the surface", { length: full })],
  };
  const [low, high] = ends[colouring];
  element("legend-low").textContent = low;
  element("legend-high").textContent = high;
  element("legend-marks").innerHTML =
    colouring === "chip" && limits
      ? `<i style="background:#8c4dbf"></i>${t("rubs (below {length})", { length: preciseLength(limits.rubbing, 3) })}<i style="background:#d9331f"></i>${t("overload (above {percent} % of the diameter)", { percent: precise(100 * limits.overloadShare, 3) })}`
      : "";
}

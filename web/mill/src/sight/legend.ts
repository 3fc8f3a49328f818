// SPDX-License-Identifier: MIT
// The legend of the colours of the part.

import { GROWTHS } from "./chatter_colours.js";
import { heat } from "./heat.js";
import { diverging, type Colouring, type HeatMap } from "./heat_map.js";
import { element } from "@tribo/ui/dom";
import type { ChipLimits } from "@tribo/protocol/frames";
import type { Vec3 } from "@tribo/protocol/vec3";

export function css(c: Vec3): string {
  return `rgb(${c.map((v) => Math.round(255 * v)).join(" ")})`;
}

// Limits are sent in single precision.
function decimal(value: number): number {
  return Number(value.toPrecision(6));
}

export function showLegend(colouring: Colouring, map: HeatMap, limits: ChipLimits | undefined): void {
  const box = element("legend");
  box.hidden = colouring === "plain";
  if (colouring === "plain") return;
  element("legend-bar").hidden = colouring === "chatter";
  if (colouring === "chatter") {
    element("legend-low").textContent = element("legend-high").textContent = "";
    element("legend-marks").innerHTML = GROWTHS.map(
      ({ words, colour }) => `<i style="background:${css(colour)}"></i>${words}`,
    ).join("");
    return;
  }
  const steps = Array.from({ length: 21 }, (_, n) => n / 20);
  const scale = colouring === "deviation" ? (t: number) => diverging(2 * t - 1) : heat;
  element("legend-bar").style.background = `linear-gradient(90deg, ${steps.map((t) => css(scale(t))).join(", ")})`;
  const mm = map.scale.deviation;
  const ends: Record<Exclude<Colouring, "plain" | "chatter">, [string, string]> = {
    force: ["peak force 0", `${map.largestForce.toFixed(0)} N`],
    chip: ["chip 0", `${map.largestChip.toFixed(3)} mm`],
    deviation: [`gouge ${mm} mm`, `${mm} mm left`],
    scallop: ["0", `${mm} mm above the surface`],
  };
  const [low, high] = ends[colouring];
  element("legend-low").textContent = low;
  element("legend-high").textContent = high;
  element("legend-marks").innerHTML =
    colouring === "chip" && limits
      ? `<i style="background:#8c4dbf"></i>rubs (below ${decimal(limits.rubbing)} mm)<i style="background:#d9331f"></i>overload (above ${decimal(100 * limits.overloadShare)} % of the diameter)`
      : "";
}

// SPDX-License-Identifier: MIT
// What the part is coloured by: choice, scale, legend, the value under the pointer, and for deviations a tolerance and a
// histogram.

import { fitToScreen } from "@tribo/ui/canvas";
import { element } from "@tribo/ui/dom";
import { roundUp } from "../lanes/bins.js";
import { diverging, type Colouring } from "../sight/heat_map.js";
import { css, showLegend } from "../sight/legend.js";
import { fixed, fromField, lengthUnit, lengthWords, onUnit, preciseLength, toField } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import type { Hit } from "../sight/part.js";
import type { Scene } from "../sight/scene.js";

const CHIP_WORDS = { rubbing: word("rubbing"), overload: word("overload") };
const HISTOGRAM_BARS = 41;
const RENEWED_MS = 500;

export interface Spread {
  // Shares of the vertices per bar from -range to range; those beyond are in the last ones.
  bars: Float32Array;
  within: number; // share inside of the tolerance
  count: number;
}

/** How many deviations are how large. */
export function spreadOf(deviations: Iterable<number>, range: number, tolerance: number): Spread {
  const bars = new Float32Array(HISTOGRAM_BARS);
  let [count, good] = [0, 0];
  for (const off of deviations) {
    const bar = Math.round(((off / range + 1) / 2) * (HISTOGRAM_BARS - 1));
    bars[Math.min(Math.max(bar, 0), HISTOGRAM_BARS - 1)]! += 1;
    if (Math.abs(off) <= tolerance) ++good;
    ++count;
  }
  if (count > 0) bars.forEach((n, k) => (bars[k] = n / count));
  return { bars, within: count > 0 ? good / count : 0, count };
}

// The colours end at the largest deviation of this share of the vertices, so that a lug does not hide the rest; and not below.
const FULL_SHARE = 0.98;
const LEAST_FULL = 1e-3;
const CLASSES_A_DECADE = 20;

/** A full scale at which the colours of these deviations differ, mm; undefined where there are none. */
export function fullScaleOf(deviations: Iterable<number>): number | undefined {
  // Classes by logarithm: the values need not be kept and sorted.
  const classes: number[] = [];
  let count = 0;
  for (const off of deviations) {
    const at = Math.max(Math.ceil(CLASSES_A_DECADE * Math.log10(Math.abs(off) / LEAST_FULL)), 0);
    classes[at] = (classes[at] ?? 0) + 1;
    ++count;
  }
  if (count === 0) return undefined;
  let [at, sum] = [-1, 0];
  while (sum < FULL_SHARE * count) sum += classes[++at] ?? 0;
  return Number(roundUp(LEAST_FULL * 10 ** (at / CLASSES_A_DECADE)).toPrecision(2));
}

export class Colours {
  readonly choice = element<HTMLSelectElement>("colouring");
  private readonly scale = element<HTMLInputElement>("scale");
  private readonly tolerance = element<HTMLInputElement>("tolerance");
  private readonly histogram = element<HTMLCanvasElement>("histogram");
  private readonly pointed = element("pointed");
  private toleranceMm = 0.05;
  // Until the user sets it, the full scale follows the part.
  private ownScale = false;
  now: Colouring = "plain";

  constructor(
    private readonly scene: Scene,
    private readonly say: (text: string) => void,
  ) {
    this.scale.addEventListener("change", () => (this.ownScale = true));
    for (const input of [this.choice, this.scale, this.tolerance])
      input.addEventListener("change", () => this.choose(this.choice.value));
    scene.canvas.addEventListener("pointermove", (event) => this.point(event));
    scene.canvas.addEventListener("pointerleave", () => (this.pointed.hidden = true));
    setInterval(() => this.renew(), RENEWED_MS);
    onUnit(() => this.showUnit());
    this.showUnit();
  }

  choose(name: string): void {
    const wanted = [...this.choice.options].find(({ value }) => value === name)?.value as Colouring | undefined;
    if (!wanted) return;
    const compares = wanted === "deviation" || wanted === "scallop";
    if (compares && !this.scene.hasDesigned) {
      this.say(t("The job has no designed surface to compare with: drop its model, or name it under [part]."));
      this.choice.value = this.now;
      return;
    }
    this.choice.value = this.now = wanted;
    element("scale-label").hidden = !compares;
    element("tolerance-label").hidden = wanted !== "deviation";
    const full = fromField(Number(this.scale.value));
    if (this.ownScale && full > 0) this.scene.heatMap.scale.deviation = full;
    if (compares) this.followPart();
    const within = fromField(Number(this.tolerance.value));
    if (within > 0) this.toleranceMm = within;
    this.scene.setColouring(wanted);
    this.renew();
  }

  // The fields keep their lengths.
  private showUnit(): void {
    this.scale.value = toField(this.scene.heatMap.scale.deviation);
    this.tolerance.value = toField(this.toleranceMm);
    for (const place of document.querySelectorAll("#panel .length-unit")) place.textContent = lengthUnit();
    this.renew();
  }

  // A scale that is too short, or more than twice too long, is set anew.
  private followPart(): boolean {
    const { scale } = this.scene.heatMap;
    const fits = this.ownScale ? undefined : fullScaleOf(this.scene.part.deviations());
    if (fits === undefined || (scale.deviation >= fits && scale.deviation <= 2 * fits)) return false;
    scale.deviation = fits;
    this.scale.value = toField(fits);
    return true;
  }

  private renew(): void {
    const { heatMap, job } = this.scene;
    if ((this.now === "deviation" || this.now === "scallop") && this.followPart()) this.scene.setColouring(this.now);
    showLegend(this.now, heatMap, job?.chipLimits);
    const compares = this.now === "deviation";
    this.histogram.hidden = element("within").hidden = !compares;
    if (compares) this.showSpread();
  }

  private showSpread(): void {
    const range = this.scene.heatMap.scale.deviation;
    const tolerance = this.toleranceMm;
    const { bars, within, count } = spreadOf(this.scene.part.deviations(), range, tolerance);
    element("within").textContent =
      count > 0
        ? t("{share} % of the machined points within ± {tolerance}", {
            share: fixed(100 * within, 1),
            tolerance: preciseLength(tolerance, 4),
          })
        : t("nothing is machined yet");
    const c = this.histogram.getContext("2d");
    const { clientWidth: width, clientHeight: height } = this.histogram;
    if (!c || width === 0) return;
    const ratio = fitToScreen(this.histogram, 2);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    const style = getComputedStyle(this.histogram);
    const band = Math.min(tolerance / range, 1) * (width / 2);
    c.fillStyle = style.getPropertyValue("--band");
    c.fillRect(width / 2 - band, 0, 2 * band, height);
    const most = Math.max(...bars, 1e-9);
    bars.forEach((share, n) => {
      c.fillStyle = css(diverging((2 * n) / (HISTOGRAM_BARS - 1) - 1));
      c.strokeStyle = style.getPropertyValue("--quiet");
      c.lineWidth = 0.5;
      const [x, wide, tall] = [(n * width) / HISTOGRAM_BARS, width / HISTOGRAM_BARS, (share / most) * (height - 2)];
      c.fillRect(x, height - tall, wide, tall);
      if (share > 0) c.strokeRect(x, height - tall, wide, tall);
    });
  }

  private point({ offsetX, offsetY, buttons, pointerType }: PointerEvent): void {
    const hit = buttons === 0 && pointerType !== "touch" ? this.scene.pick(offsetX, offsetY) : undefined;
    const words = hit ? this.words(hit) : "";
    this.pointed.hidden = words === "";
    if (words === "") return;
    this.pointed.textContent = words;
    this.pointed.style.left = `${offsetX + 14}px`;
    this.pointed.style.top = `${offsetY + 14}px`;
  }

  private words(hit: Hit): string {
    if (this.now === "deviation" || this.now === "scallop") {
      if (Number.isNaN(hit.deviation)) return t("over {far} from the designed surface", { far: preciseLength(3, 3) });
      const size = { length: lengthWords(Math.abs(hit.deviation), 3) };
      return hit.deviation < 0 ? t("gouge {length}", size) : t("{length} left", size);
    }
    if (this.now === "plain") return "";
    if (hit.untouched) return t("untouched");
    const row = this.scene.heatMap.rowAt(hit.point);
    if (!row) return "";
    const { line } = row;
    if (this.now === "force") return t("{force} N, line {line}", { force: fixed(row.peakForce, 0), line });
    if (this.now === "chip") {
      const chip = t("chip {length}", { length: lengthWords(row.chip, 3) });
      return [chip, row.chipVerdict && t(CHIP_WORDS[row.chipVerdict]), t("line {line}", { line })]
        .filter(Boolean)
        .join(", ");
    }
    return row.multiplier > 0
      ? t("multiplier {mu}, line {line}", { mu: fixed(row.multiplier, 2), line })
      : t("line {line}", { line });
  }
}

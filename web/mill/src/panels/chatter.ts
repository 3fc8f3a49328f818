// SPDX-License-Identifier: MIT
// Whether the cut at the clock chatters, and its chart of speeds and depths with the moving point. A click on a speed
// turns the spindle at it.

import type { ChartFrame, StateFrame } from "@tribo/protocol/frames";
import { fitToScreen } from "@tribo/ui/canvas";
import { oncePerFrame } from "@tribo/ui/frame";
import { element } from "@tribo/ui/dom";
import { fixed, lengthUnit, onUnit, precise, preciseLength, toField } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";

// As in stability.svg (src/report/chart): a vibration that grows by at most so much in a period.
const CELLS: [most: number, colour: [number, number, number]][] = [
  [1.1, [252, 222, 161]],
  [1.3, [245, 173, 97]],
  [2, [212, 115, 74]],
  [Infinity, [140, 64, 66]],
];
const NOTHING_CUT = word("nothing is cut");
type Pocket = ChartFrame["pockets"][number];

const LEFT = 34;
const RIGHT = 8;
const TOP = 6;
const BOTTOM = 30;

export function verdict(multiplier: number, hz: number): string {
  if (!(multiplier > 0)) return t("not known here");
  return multiplier > 1 ? t("chatters at {hz} Hz", { hz: fixed(hz, 0) }) : t("stable");
}

// A round number that is about the `ways`th part of a range.
function tickStep(range: number, ways: number): number {
  const least = range / ways;
  const decade = 10 ** Math.floor(Math.log10(least));
  return decade * ([1, 2, 5].find((times) => times * decade >= least) ?? 10);
}

export class ChatterPanel {
  private readonly box = element("chatter");
  private readonly canvas = element<HTMLCanvasElement>("chatter-chart");
  private readonly best = element<HTMLButtonElement>("chatter-best");
  private chart: ChartFrame | undefined;
  private cells: HTMLCanvasElement | undefined;
  private state: StateFrame | undefined;
  // The pocket nearest to the speed of the program.
  private pocket: Pocket | undefined;
  private programmedRpm = 0;
  private readonly paintNext = oncePerFrame(() => this.paint());

  constructor(private readonly turnAt: (rpm: number) => void) {
    this.canvas.addEventListener("click", (event) => {
      const { chart } = this;
      if (!chart) return;
      const share = (event.offsetX - LEFT) / (this.canvas.clientWidth - LEFT - RIGHT);
      const [from, to] = ends(chart);
      if (share >= 0 && share <= 1) this.turnAt(from + share * (to - from));
    });
    this.best.addEventListener("click", () => {
      if (this.pocket) this.turnAt(this.pocket.rpm);
    });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    onUnit(() => {
      this.recommend();
      this.draw();
    });
  }

  // A new job. What bends is told after it.
  begin(): void {
    this.box.hidden = true;
    this.chart = this.cells = this.state = this.pocket = undefined;
    this.canvas.hidden = this.best.hidden = true;
    element("chatter-verdict").textContent = t(NOTHING_CUT);
    element("chatter-number").textContent = this.box.dataset.growth = "";
  }
  open(): void {
    this.box.hidden = false;
    this.draw();
  }

  take(chart: ChartFrame): void {
    this.chart = chart;
    this.cells = cellsOf(chart);
    this.recommend();
    this.canvas.hidden = false;
    this.draw();
  }

  show(state: StateFrame, programmedRpm: number): void {
    if (this.box.hidden) return;
    this.state = state;
    if (Math.abs(programmedRpm - this.programmedRpm) > 1) {
      this.programmedRpm = programmedRpm;
      this.recommend();
    }
    const { chatter } = state;
    const words = !chatter ? t(NOTHING_CUT) : verdict(chatter.multiplier, chatter.hz);
    const number = chatter && chatter.multiplier > 0 ? fixed(chatter.multiplier, 2) : "";
    for (const [id, text] of [
      ["chatter-verdict", words],
      ["chatter-number", number],
    ] as const) {
      if (element(id).textContent !== text) element(id).textContent = text;
    }
    this.box.dataset.growth = !number ? "" : chatter!.multiplier > 1 ? "chatters" : "stable";
    this.draw();
  }

  private recommend(): void {
    const off = ({ rpm }: Pocket) => Math.abs(Math.log(rpm / this.programmedRpm));
    this.pocket = this.chart?.pockets.reduce<Pocket | undefined>(
      (best, other) => (best && off(best) <= off(other) ? best : other),
      undefined,
    );
    this.best.hidden = !this.pocket;
    if (!this.pocket) return;
    const { rpm, depth } = this.pocket;
    this.best.textContent = t("Turn at {rpm} rpm: stable to {depth}", {
      rpm: precise(rpm, 5),
      depth: preciseLength(depth, 3),
    });
  }

  private draw(): void {
    if (!this.box.hidden) this.paintNext();
  }

  private paint(): void {
    const { canvas, chart, cells } = this;
    const c = canvas.getContext("2d");
    if (!c || !chart || !cells || canvas.clientWidth === 0) return;
    fitToScreen(canvas, 2);
    const ratio = canvas.width / canvas.clientWidth;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const style = getComputedStyle(canvas);
    const [ink, faint, paper] = ["--ink", "--line", "--paper"].map((name) => style.getPropertyValue(name));
    const [width, height] = [canvas.clientWidth - LEFT - RIGHT, canvas.clientHeight - TOP - BOTTOM];
    const [from, to] = ends(chart);
    const most = (chart.depths + 0.5) * chart.stepMm;
    const x = (rpm: number) => LEFT + ((rpm - from) / (to - from)) * width;
    const y = (mm: number) => TOP + height - (mm / most) * height;
    c.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    c.fillStyle = paper!;
    c.fillRect(LEFT, TOP, width, height);
    c.imageSmoothingEnabled = false;
    // The first depth stands in the middle of its cell.
    c.drawImage(cells, LEFT, TOP, width, y(0.5 * chart.stepMm) - TOP);

    c.font = "11px system-ui, sans-serif";
    c.textBaseline = "middle";
    c.strokeStyle = faint!;
    c.fillStyle = ink!;
    c.lineWidth = 1;
    const stepRpm = tickStep(to - from, 5);
    c.textAlign = "center";
    for (let rpm = Math.ceil(from / stepRpm) * stepRpm; rpm <= to; rpm += stepRpm) {
      line(c, x(rpm), TOP, x(rpm), TOP + height + 4);
      c.fillText(String(Math.round(rpm)), Math.min(x(rpm), LEFT + width - 12), TOP + height + 11);
    }
    const stepMm = tickStep(Number(toField(most)), 5) / (Number(toField(most)) / most);
    c.textAlign = "right";
    for (let mm = 0; mm <= most; mm += stepMm) {
      line(c, LEFT - 3, y(mm), LEFT + width, y(mm));
      c.fillText(String(Number(Number(toField(mm)).toPrecision(3))), LEFT - 6, y(mm));
    }
    c.textAlign = "center";
    c.fillText(t("speed, rpm; depth, {unit}", { unit: lengthUnit() }), LEFT + width / 2, TOP + height + 23);

    c.strokeStyle = ink!;
    c.lineWidth = 2;
    c.beginPath();
    chart.limits.forEach((limit, n) => {
      if (limit !== 0) c.lineTo(x(chart.fromRpm + n * chart.stepRpm), y(Number.isNaN(limit) ? most : limit));
    });
    c.stroke();
    c.lineWidth = 1;
    c.strokeRect(LEFT, TOP, width, height);

    for (const { rpm, depth } of chart.pockets) disc(c, x(rpm), y(depth), 4, "#005c9e");
    this.paintPoint(c, x, y, LEFT + width);
  }

  // The cut now, at the border of the chart if it is beyond.
  private paintPoint(
    c: CanvasRenderingContext2D,
    x: (rpm: number) => number,
    y: (mm: number) => number,
    right: number,
  ): void {
    const { state } = this;
    if (!state?.chatter || !(state.chatter.depth > 0)) return;
    const [px, py] = [Math.min(Math.max(x(state.rpm), LEFT), right), Math.max(y(state.chatter.depth), TOP)];
    // A ring where it is stable, a cross where it chatters: not by colour alone.
    const bad = state.chatter.multiplier > 1;
    disc(c, px, py, 8, "#ffffff");
    disc(c, px, py, 6.5, bad ? "#d11a1a" : "#00734d");
    c.strokeStyle = "#ffffff";
    c.lineWidth = 2;
    if (bad) {
      line(c, px - 3, py - 3, px + 3, py + 3);
      line(c, px - 3, py + 3, px + 3, py - 3);
    } else {
      disc(c, px, py, 2.5, "#ffffff");
    }
  }
}

function ends({ fromRpm, stepRpm, limits }: ChartFrame): [number, number] {
  return [fromRpm - 0.5 * stepRpm, fromRpm + (limits.length - 0.5) * stepRpm];
}

// A pixel for each point. A speed that is not computed yet looks as the one to its left.
function cellsOf({ limits, depths, multipliers }: ChartFrame): HTMLCanvasElement | undefined {
  const cells = document.createElement("canvas");
  cells.width = limits.length;
  cells.height = depths;
  const c = cells.getContext("2d");
  if (!c || limits.length * depths === 0) return undefined;
  const image = c.createImageData(limits.length, depths);
  let known = 0;
  limits.forEach((limit, speed) => {
    if (limit !== 0) known = speed;
    for (let depth = 0; depth < depths; ++depth) {
      const multiplier = multipliers[known * depths + depth]!;
      if (!(multiplier > 1)) continue;
      const [, colour] = CELLS.find(([most]) => multiplier <= most)!;
      image.data.set([...colour, 255], 4 * ((depths - 1 - depth) * limits.length + speed));
    }
  });
  c.putImageData(image, 0, 0);
  return cells;
}

function line(c: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  c.stroke();
}

function disc(c: CanvasRenderingContext2D, x: number, y: number, radius: number, colour: string): void {
  c.fillStyle = colour;
  c.beginPath();
  c.arc(x, y, radius, 0, 2 * Math.PI);
  c.fill();
}

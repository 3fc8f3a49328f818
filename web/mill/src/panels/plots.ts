// SPDX-License-Identifier: MIT
// Detailed plots, loaded when they are opened: force over time, force over a turn, its spectrum, engagement, and a
// spectrogram of the sound.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { overTime, type History } from "./history.js";
import { theme } from "../page.js";
import { heat } from "../sight/heat.js";
import type { Sound } from "../sound/sound.js";
import { lengthUnit, onUnit, precise, toField } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import { spectrum, turn } from "./turn.js";

const DEG = 180 / Math.PI;
// Upper frequency of the spectrogram, Hz, and its lowest level, dB.
const TOP_HZ = 8000;
const FLOOR_DB = -100;
const CEILING_DB = -20;

interface View {
  name: string;
  series: { label: string; stroke: string; bars?: boolean }[];
  axes: [string, string];
  data(history: History): uPlot.AlignedData;
  seek?: boolean;
}

const VIEWS: View[] = [
  {
    name: word("Force"),
    series: [
      { label: word("peak, N"), stroke: "#d0342c" },
      { label: word("mean, N"), stroke: "#3b82d0" },
    ],
    axes: ["s", "N"],
    data: (h) =>
      overTime(
        h.rows,
        (row) => row.peakForce,
        (row) => row.meanForce,
      ),
    seek: true,
  },
  {
    name: word("One turn"),
    series: [
      { label: word("along the feed, N"), stroke: "#d0342c" },
      { label: word("to its left, N"), stroke: "#3b82d0" },
      { label: word("to the shank, N"), stroke: "#b58900" },
    ],
    axes: [word("degrees of the spindle"), "N"],
    data: (h) => {
      const piece = h.piece();
      if (!piece) return [[], [], [], []];
      const one = turn(piece);
      return [one.degrees, one.x, one.y, one.z];
    },
  },
  {
    name: word("Spectrum"),
    series: [{ label: word("force across the axis, N"), stroke: "#3b82d0", bars: true }],
    axes: ["Hz", "N"],
    data: (h) => {
      const piece = h.piece();
      if (!piece) return [[], []];
      const s = spectrum(piece);
      return [s.hz, s.newton];
    },
  },
  {
    name: word("Engagement"),
    series: [
      { label: word("exit, degrees"), stroke: "#d0342c" },
      { label: word("entry, degrees"), stroke: "#3b82d0" },
      { label: word("depth, {unit}"), stroke: "#b58900" },
    ],
    axes: ["s", word("degrees, {unit}")],
    data: (h) =>
      overTime(
        h.rows,
        (row) => row.exit * DEG,
        (row) => row.entry * DEG,
        (row) => Number(toField(row.depth)),
      ),
    seek: true,
  },
];
const CHATTER = word("Chatter");
VIEWS.push({
  name: CHATTER,
  series: [{ label: word("multiplier, above 1: chatter"), stroke: "#d0342c" }],
  axes: ["s", word("growth")],
  data: (h) => overTime(h.rows, (row) => row.multiplier),
  seek: true,
});
const SOUND = word("Sound");

export class Plots {
  private readonly tabs = document.createElement("div");
  private readonly panel = document.createElement("div");
  private plot: uPlot | undefined;
  private open = VIEWS[0]!.name;
  private dirty = true;
  private drawnTheme = theme();
  private heard: HTMLCanvasElement | undefined;
  private readonly chatter: HTMLElement;

  constructor(
    private readonly box: HTMLElement,
    private readonly history: History,
    private readonly sound: Sound,
    private readonly seek: (time: number) => void,
  ) {
    this.tabs.setAttribute("role", "tablist");
    this.tabs.setAttribute("aria-label", t("Plots"));
    this.panel.setAttribute("role", "tabpanel");
    this.panel.id = "plot-panel";
    this.panel.tabIndex = 0;
    for (const name of [...VIEWS.map((v) => v.name), SOUND]) {
      const tab = document.createElement("button");
      tab.type = "button";
      tab.id = `tab-${name.replace(" ", "-").toLowerCase()}`;
      tab.setAttribute("role", "tab");
      tab.setAttribute("aria-controls", this.panel.id);
      tab.dataset.view = name;
      tab.textContent = t(name);
      tab.addEventListener("click", () => this.choose(name));
      this.tabs.append(tab);
    }
    this.chatter = [...this.tabs.children].find((tab) => (tab as HTMLElement).dataset.view === CHATTER) as HTMLElement;
    this.chatter.hidden = true;
    this.tabs.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
      if (step === 0) return;
      const all = ([...this.tabs.children] as HTMLElement[]).filter((tab) => !tab.hidden);
      const next = all[(all.findIndex((tab) => tab.dataset.view === this.open) + step + all.length) % all.length]!;
      next.click();
      next.focus();
    });
    box.append(this.tabs, this.panel);
    new ResizeObserver(() => {
      this.plot?.setSize(this.size());
      this.dirty = true;
    }).observe(this.panel);
    onUnit(() => this.choose(this.open));
    // The page may draw no picture for a while.
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.update());
    this.choose(this.open);
  }

  // Called once per picture while the plots are open.
  update(): void {
    if (this.box.hidden) return;
    this.chatter.hidden = !this.history.bends;
    const now = theme();
    this.dirty ||= now !== this.drawnTheme;
    this.drawnTheme = now;
    if (this.open === SOUND) {
      this.drawSound();
    } else if (this.dirty) {
      this.dirty = false;
      const view = VIEWS.find((v) => v.name === this.open)!;
      this.plot?.setData(view.data(this.history));
    }
  }
  changed(): void {
    this.dirty = true;
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(this.panel.clientWidth, 100), height: Math.max(this.panel.clientHeight - 34, 60) };
  }

  private choose(name: string): void {
    this.open = name;
    for (const tab of this.tabs.children) {
      const on = (tab as HTMLElement).dataset.view === name;
      tab.setAttribute("aria-selected", String(on));
      (tab as HTMLElement).tabIndex = on ? 0 : -1;
      if (on) this.panel.setAttribute("aria-labelledby", tab.id);
    }
    this.plot?.destroy();
    this.plot = undefined;
    this.heard = undefined;
    this.panel.replaceChildren();
    const view = VIEWS.find((v) => v.name === name);
    if (view) this.make(view);
    else this.makeSound();
    this.dirty = true;
  }

  private make(view: View): void {
    // Of the theme at the time of drawing.
    const colour = (name: string) => () => getComputedStyle(this.box).getPropertyValue(name);
    const ink = colour("--ink");
    const faint = colour("--line");
    const unit = lengthUnit();
    const axis = (label: string): uPlot.Axis => ({
      label: t(label, { unit }),
      stroke: ink,
      grid: { stroke: faint, width: 1 },
      ticks: { stroke: faint },
      labelSize: 18,
      size: label === "N" || label.startsWith("degrees,") ? 56 : 34,
    });
    this.plot = new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false } },
        hooks: { draw: view.seek ? [(plot) => this.drawNow(plot, ink())] : [] },
        cursor: { drag: { x: true, y: false } },
        axes: view.axes.map(axis),
        series: [
          { label: t(view.axes[0]) },
          ...view.series.map((s) => ({
            label: t(s.label, { unit }),
            stroke: s.stroke,
            width: 1.5,
            points: { show: false },
            value: (_: uPlot, v: number | null) => (typeof v === "number" ? precise(v, 3) : ""),
            // A row stands for its whole time.
            ...(view.seek ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
            ...(s.bars ? { paths: uPlot.paths.bars!({ size: [0.5, 24] }), fill: `${s.stroke}66` } : {}),
          })),
        ],
      },
      view.data(this.history),
      this.panel,
    );
    if (view.seek) {
      const { plot } = this;
      plot.over.addEventListener("dblclick", () => this.seek(plot.posToVal(plot.cursor.left ?? 0, "x")));
    }
  }

  private drawNow(plot: uPlot, ink: string): void {
    const { ctx, bbox } = plot;
    const x = plot.valToPos(this.history.time, "x", true);
    if (!(x >= bbox.left && x <= bbox.left + bbox.width)) return;
    ctx.fillStyle = ink;
    ctx.fillRect(x - devicePixelRatio, bbox.top, 2 * devicePixelRatio, bbox.height);
  }

  private makeSound(): void {
    const canvas = document.createElement("canvas");
    canvas.className = "spectrogram";
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", t("Spectrogram of the sound, 0 to {khz} kHz", { khz: TOP_HZ / 1000 }));
    this.panel.append(canvas);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight));
    this.heard = canvas;
  }

  private drawSound(): void {
    const canvas = this.heard;
    const context = canvas?.getContext("2d");
    if (!canvas || !context) return;
    const { analyser } = this.sound;
    const { width, height } = canvas;
    if (!analyser || !this.sound.running) {
      context.clearRect(0, 0, width, height);
      context.fillStyle = getComputedStyle(this.box).getPropertyValue("--quiet");
      context.font = "14px system-ui, sans-serif";
      context.fillText(t("The sound is off: press Sound."), 12, 24);
      return;
    }
    const levels = new Float32Array(analyser.frequencyBinCount);
    analyser.getFloatFrequencyData(levels);
    context.drawImage(canvas, -1, 0);
    const bins = (TOP_HZ / (analyser.context.sampleRate / 2)) * levels.length;
    for (let y = 0; y < height; ++y) {
      const level = levels[Math.floor(((height - 1 - y) / height) * bins)]!;
      const [r, g, b] = heat((level - FLOOR_DB) / (CEILING_DB - FLOOR_DB));
      context.fillStyle = `rgb(${r * 255} ${g * 255} ${b * 255})`;
      context.fillRect(width - 1, y, 1, 1);
    }
    context.fillStyle = "#ffffffb0";
    context.font = "11px system-ui, sans-serif";
    for (let khz = 2; khz < TOP_HZ / 1000; khz += 2) {
      const y = height - (khz * 1000 * height) / TOP_HZ;
      context.fillRect(0, y, 4, 1);
    }
  }
}

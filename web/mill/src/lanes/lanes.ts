// SPDX-License-Identifier: MIT
// Lanes of the cut on one axis of time, which is the slider of the program: force with its band, depth, chip, power,
// vibration, sound, and events.

import type { Piece, Row } from "@tribo/protocol/frames";
import { fitToScreen } from "@tribo/ui/canvas";
import { oncePerFrame } from "@tribo/ui/frame";
import { clock, theme } from "../page.js";
import { fixed, length, lengthUnit, onUnit } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import { growthColour } from "../sight/chatter_colours.js";
import { heat } from "../sight/heat.js";
import { css } from "../sight/legend.js";
import { Bins, roundUp, timeMarks } from "./bins.js";
import { level } from "./level.js";
import { nextProblem, type Event, type Happened } from "./problems.js";

export type Quantity = "force" | "depth" | "chip" | "power" | "multiplier" | "sound";

interface Lane {
  name: string;
  unit: () => string;
  digits: (value: number) => string;
  // Of a row; the sound is not of rows.
  of?: (row: Row) => number;
  // Shown where the lanes are few.
  first?: boolean;
  // Share of the height of the force.
  height: number;
}

const LANES: Record<Quantity, Lane> = {
  force: {
    name: word("peak force"),
    unit: () => "N",
    digits: (v) => fixed(v, 0),
    of: (row) => row.peakForce,
    first: true,
    height: 1,
  },
  depth: {
    name: word("depth of cut"),
    unit: lengthUnit,
    digits: (v) => length(v, 2),
    of: (row) => row.depth,
    first: true,
    height: 0.6,
  },
  multiplier: {
    name: word("chatter, |mu|"),
    unit: () => "",
    digits: (v) => fixed(v, 2),
    of: (row) => row.multiplier,
    first: true,
    height: 0.6,
  },
  chip: {
    name: word("thickest chip"),
    unit: lengthUnit,
    digits: (v) => length(v, 3),
    of: (row) => row.chip,
    height: 0.6,
  },
  power: {
    name: word("spindle power"),
    unit: () => "W",
    digits: (v) => fixed(v, 0),
    of: (row) => row.torque * row.rpm * (Math.PI / 30),
    height: 0.6,
  },
  sound: { name: word("sound over the softest"), unit: () => "dB", digits: (v) => fixed(v, 0), height: 0.6 },
};
const ORDER: Quantity[] = ["force", "depth", "multiplier", "chip", "power", "sound"];
const EVENT_COLOURS: Record<Event, string> = { damage: "--damage", overload: "--overload", rubbing: "--rubbing" };
// Heights in CSS pixels: a lane, the row of events, the axis.
const FORCE_PX = 58;
const EVENTS_PX = 9;
const AXIS_PX = 17;
const FONT = "11px system-ui, sans-serif";
const RENEWED_MS = 250;
const GAP_PX = 5;
// A window so low has room for one lane.
const LOW = "(max-height: 480px)";

export class Lanes {
  private readonly bins = Object.fromEntries(ORDER.map((name) => [name, new Bins()])) as Record<Quantity, Bins>;
  private events: Happened[] = [];
  // The ends of the band of the force.
  private readonly low = new Bins();
  private readonly high = new Bins();
  private duration = 1;
  private time = 0;
  private milled = 0;
  private pointed: number | undefined;
  private all = false;
  private readonly draw = oncePerFrame(() => this.paint());
  private readonly ground = document.createElement("canvas");
  private groundLook = "";
  private groundAt = 0;
  // Values have come that are not in it.
  private stale = true;
  private readonly inks = new Map<string, string>();
  private readonly lowWindow = matchMedia(LOW);

  constructor(
    private readonly canvas: HTMLCanvasElement,
    slider: HTMLElement,
    private readonly rowAt: (time: number) => Row | undefined,
  ) {
    slider.addEventListener("pointermove", ({ offsetX }) => this.point((offsetX / slider.clientWidth) * this.duration));
    slider.addEventListener("pointerleave", () => this.point(undefined));
    new ResizeObserver(() => this.draw()).observe(canvas);
    this.lowWindow.addEventListener("change", () => this.lay());
    onUnit(() => this.draw());
    new MutationObserver(() => this.draw()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  begin(duration: number): void {
    this.duration = Math.max(duration, 1e-9);
    for (const bins of [...Object.values(this.bins), this.low, this.high]) bins.begin(duration);
    this.events = [];
    this.milled = 0;
    this.lay();
  }
  // The rows before are void; what happened stays, and what was heard.
  forgetRows(): void {
    for (const [name, bins] of Object.entries(this.bins)) if (name !== "sound") bins.clear();
    this.low.clear();
    this.high.clear();
    this.events = this.events.filter(({ what }) => what === "damage");
    this.changed();
  }

  addRows(rows: readonly Row[]): void {
    const had = this.shown().length;
    for (const row of rows) {
      const { time, duration } = row;
      for (const name of ORDER) this.bins[name].add(time, duration, LANES[name].of?.(row) ?? 0);
      this.low.add(time, duration, row.peakLow);
      this.high.add(time, duration, row.peakHigh);
      if (row.chipVerdict) this.events.push({ time, what: row.chipVerdict });
    }
    if (this.shown().length !== had) this.lay();
    this.changed();
  }
  addMultipliers(rows: readonly Row[]): void {
    const had = this.shown().length;
    for (const { time, duration, multiplier } of rows) this.bins.multiplier.add(time, duration, multiplier);
    if (this.shown().length !== had) this.lay();
    this.changed();
  }
  addPieces(pieces: readonly Piece[]): void {
    for (const piece of pieces) this.bins.sound.add(piece.time, piece.duration, level(piece));
    this.stale = true;
  }
  addDamage(time: number): void {
    this.events.push({ time, what: "damage" });
    this.changed();
  }

  problemAfter(time: number): Happened | undefined {
    return nextProblem(this.events, time);
  }

  show(time: number, milled: number): void {
    this.time = time;
    this.milled = Math.max(this.milled, milled);
    this.draw();
  }
  // Of all quantities, or of the first ones.
  showAll(all: boolean): void {
    this.all = all;
    this.lay();
  }

  private shown(): Quantity[] {
    return ORDER.filter((name) => {
      const known = name !== "multiplier" || this.bins.multiplier.largest > 0;
      return known && (this.all || (this.lowWindow.matches ? name === "force" : LANES[name].first));
    });
  }

  private point(time: number | undefined): void {
    this.pointed = time === undefined ? undefined : Math.min(Math.max(time, 0), this.duration);
    this.draw();
  }

  private lay(): void {
    const lanes = this.shown().reduce((sum, name) => sum + FORCE_PX * LANES[name].height + GAP_PX, 0);
    this.canvas.style.height = `${lanes + EVENTS_PX + AXIS_PX}px`;
    this.groundLook = "";
    this.draw();
  }
  private changed(): void {
    this.stale = true;
    this.draw();
  }

  private paint(): void {
    const c = this.canvas.getContext("2d");
    const { clientWidth: width } = this.canvas;
    if (!c || width === 0) return;
    const ratio = fitToScreen(this.canvas, 2);
    const ground = this.groundNow(width, ratio);
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.drawImage(ground, 0, 0);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.font = FONT;
    const x = (time: number) => (time / this.duration) * width;
    const bottom = this.canvas.clientHeight - AXIS_PX;
    // What is not milled yet.
    c.fillStyle = this.ink("--veil");
    c.fillRect(x(this.milled), 0, width - x(this.milled), bottom);
    let top = 0;
    for (const name of this.shown()) {
      this.paintWords(c, name, top, width);
      top += FORCE_PX * LANES[name].height + GAP_PX;
    }
    if (this.pointed !== undefined) {
      c.fillStyle = this.ink("--quiet");
      c.fillRect(x(this.pointed), 0, 1, bottom);
      c.fillText(clock(this.pointed), Math.min(x(this.pointed) + 4, width - 40), bottom - 1);
    }
    c.fillStyle = this.ink("--ink");
    c.fillRect(Math.min(Math.max(x(this.time) - 1, 0), width - 2), 0, 2, bottom);
  }

  // What does not move with the clock. New values appear in it a few times a second.
  private groundNow(width: number, ratio: number): HTMLCanvasElement {
    const { ground, canvas } = this;
    const look = `${canvas.width} ${canvas.height} ${theme()}`;
    const now = performance.now();
    if (look === this.groundLook && (!this.stale || now - this.groundAt < RENEWED_MS)) {
      // Once more, in case nothing else is drawn.
      if (this.stale) setTimeout(() => this.draw(), RENEWED_MS);
      return ground;
    }
    this.stale = false;
    this.groundAt = now;
    if (look !== this.groundLook) this.inks.clear();
    this.groundLook = look;
    ground.width = canvas.width;
    ground.height = canvas.height;
    const c = ground.getContext("2d")!;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.font = FONT;
    let top = 0;
    for (const name of this.shown()) {
      const height = FORCE_PX * LANES[name].height;
      this.paintLane(c, name, top, width, height);
      top += height + GAP_PX;
    }
    const x = (time: number) => (time / this.duration) * width;
    for (const { time, what } of this.events) {
      c.fillStyle = this.ink(EVENT_COLOURS[what]);
      c.fillRect(x(time) - 1, top + (what === "damage" ? 0 : 2), what === "damage" ? 3 : 2, EVENTS_PX - 2);
    }
    top += EVENTS_PX;
    c.fillStyle = this.ink("--quiet");
    for (const time of timeMarks(this.duration, width / 90)) {
      const text = clock(time);
      const half = c.measureText(text).width / 2;
      c.fillRect(x(time), top, 1, 4);
      c.fillText(text, Math.min(Math.max(x(time) - half, 0), width - 2 * half), top + AXIS_PX - 3);
    }
    return ground;
  }

  // A colour of the page.
  private ink(name: string): string {
    let colour = this.inks.get(name);
    if (colour === undefined) this.inks.set(name, (colour = getComputedStyle(this.canvas).getPropertyValue(name)));
    return colour;
  }

  private paintLane(c: CanvasRenderingContext2D, name: Quantity, top: number, width: number, height: number): void {
    const bins = this.bins[name];
    const columns = bins.columns(Math.round(width));
    const [lows, highs] = name === "force" ? [this.low, this.high].map((end) => end.columns(columns.length)) : [];
    const most = this.end(name);
    const bottom = top + height;
    const y = (value: number) => bottom - Math.min(value / most, 1) * (height - 1);
    c.fillStyle = this.ink("--line");
    c.fillRect(0, bottom, width, 1);
    columns.forEach((value, n) => {
      if (Number.isNaN(value)) return;
      const low = lows?.[n] ?? 0;
      const high = highs?.[n] ?? 0;
      const spreads = low < high;
      if (spreads) {
        c.fillStyle = this.ink("--band");
        c.fillRect(n, y(high), 1, y(low) - y(high));
      }
      c.fillStyle = css((name === "multiplier" ? growthColour(value) : undefined) ?? heat(value / bins.largest));
      c.globalAlpha = name === "force" ? 0.95 : 0.6;
      c.fillRect(n, y(value), 1, bottom - y(value));
      c.globalAlpha = 1;
      if (!spreads) return;
      c.fillStyle = this.ink("--band-low");
      c.fillRect(n, y(low), 1, 1);
    });
    if (name === "multiplier" && most > 1) {
      c.fillStyle = this.ink("--damage");
      c.fillRect(0, y(1), width, 1);
    }
  }

  private paintWords(c: CanvasRenderingContext2D, name: Quantity, top: number, width: number): void {
    const at = this.pointed ?? this.time;
    const { name: words, digits, unit } = LANES[name];
    const bins = this.bins[name];
    const said = { lane: t(words), most: `${digits(this.end(name))} ${unit()}`.trim() };
    const end = bins.largest > 0 ? t("{lane}, to {most}", said) : t("{lane}: none yet", said);
    const paper = this.ink("--card");
    label(c, end, 3, top + 10, this.ink("--quiet"), paper);
    const named = c.measureText(end).width + 8;
    // That of the row itself, as beside the picture: a bin has the largest of its rows.
    const row = this.rowAt(at);
    const value = (row && LANES[name].of?.(row)) ?? bins.at(at);
    if (!(value > 0)) return;
    const now = `${digits(value)} ${unit()}`.trim();
    const x = (at / this.duration) * width + 6;
    const wide = c.measureText(now).width;
    label(c, now, x + wide > width ? x - 12 - wide : x, top + (x < named ? 23 : 11), this.ink("--ink"), paper);
  }

  // End of the axis. The band may leave the lane; the force may not.
  private end(name: Quantity): number {
    const { largest } = this.bins[name];
    return roundUp(name === "force" ? Math.min(Math.max(this.high.largest, largest), 1.8 * largest) : largest);
  }
}

function label(c: CanvasRenderingContext2D, text: string, x: number, y: number, ink: string, paper: string): void {
  c.textBaseline = "alphabetic";
  c.fillStyle = paper;
  c.fillRect(x - 2, y - 10, c.measureText(text).width + 4, 13);
  c.fillStyle = ink;
  c.fillText(text, x, y);
}

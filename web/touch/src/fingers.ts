// SPDX-License-Identifier: MIT
// Converts pointer reports of a screen to input for a sheet and a voice: an ellipse, a force, a speed.
import { clamp } from "@tribo/ui/clamp";
import type { Contact } from "./engine.js";

/** One report about one finger, in mm of the image and seconds. */
export interface FingerReport {
  x: number;
  y: number;
  /** Size of the touch in mm; 0: the screen does not report it. */
  width: number;
  height: number;
  /** 0 to 1, or NaN if the screen does not measure it. */
  pressure: number;
  time: number;
}

// Force of a full press, and the time to reach it if the pressure is not measured.
export const kFullForceN = 2;
const kGrowthS = 0.25;
const kMeasuredForceN = 3;
const kDefaultRadiusMm = 6;
const kLeastRadiusMm = 1;
const kMostRadiusMm = 15;
// The speed is the distance of the last reports over their time. A finger without reports stands still.
const kSpeedWindowS = 0.03;
const kStandsStillS = 0.05;
// For a finger without motion in the window, a new motion took only this time: one report of a 60 Hz screen.
const kReportS = 0.016;

interface Place {
  x: number;
  y: number;
  time: number;
}

export class Finger {
  /** Position of the last report. */
  x = 0;
  y = 0;
  #since: number;
  #pressure = 0;
  #halfWidth = kDefaultRadiusMm;
  #halfHeight = kDefaultRadiusMm;
  #trail: Place[] = [];
  // Position predicted by the browser.
  #ahead: Place | undefined;
  // Where the last frame drew it.
  #drawn: { x: number; y: number } | undefined;
  /** Factor on the usual force; the keyboard changes it. */
  firmness = 1;

  constructor(report: FingerReport) {
    this.#since = report.time;
    this.move(report);
  }

  /** `ahead`: predicted position, if available. */
  move(report: FingerReport, ahead?: Place): void {
    this.#ahead = ahead && ahead.time > report.time ? ahead : undefined;
    this.x = report.x;
    this.y = report.y;
    this.#pressure = report.pressure;
    const radius = (size: number) => (size > 0 ? clamp(size / 2, kLeastRadiusMm, kMostRadiusMm) : kDefaultRadiusMm);
    this.#halfWidth = radius(report.width);
    this.#halfHeight = radius(report.height);
    const last = this.#trail.at(-1);
    const from = report.time - kSpeedWindowS;
    if (last && last.time < from) this.#trail = [{ ...last, time: report.time - kReportS }];
    this.#trail.push(report);
    while (this.#trail.length > 2 && this.#trail[1]!.time <= from) this.#trail.shift();
  }

  held(now: number): number {
    return Math.max(0, now - this.#since);
  }

  force(now: number): number {
    const firm = this.firmness;
    if (Number.isNaN(this.#pressure)) return firm * kFullForceN * (1 - Math.exp(-this.held(now) / kGrowthS));
    return firm * kMeasuredForceN * this.#pressure;
  }

  /** mm/s along the surface, over the last reports and the predicted distance, so that the delay is small. */
  speed(now: number): number {
    const last = this.#trail.at(-1)!;
    if (now - last.time > kStandsStillS) return 0;
    const way = this.#ahead ? [...this.#trail, this.#ahead] : this.#trail;
    let length = 0;
    for (let i = 1; i < way.length; ++i) length += Math.hypot(way[i]!.x - way[i - 1]!.x, way[i]!.y - way[i - 1]!.y);
    const seconds = way.at(-1)!.time - way[0]!.time;
    return seconds > 0 ? length / seconds : 0;
  }

  /** For the frame at `now`. */
  contact(now: number): Contact {
    const last = this.#trail.at(-1)!;
    const ahead = this.#ahead ?? last;
    // A report is some milliseconds old when it is drawn, but the dent should be under the finger.
    const part = clamp((now - last.time) / (ahead.time - last.time || 1), 0, 1);
    const x = last.x + part * (ahead.x - last.x);
    const y = last.y + part * (ahead.y - last.y);
    const before = this.#drawn ?? { x, y };
    this.#drawn = { x, y };
    return {
      x,
      y,
      dx: x - before.x,
      dy: y - before.y,
      halfWidth: this.#halfWidth,
      halfHeight: this.#halfHeight,
      force: this.force(now),
      held: this.held(now),
    };
  }

  get area(): number {
    return Math.PI * this.#halfWidth * this.#halfHeight;
  }
}

/** The measured pressure of a pointer, or NaN: a mouse reports 0.5, a screen without a sensor 0, 0.5 or 1. */
export function measuredPressure(event: PointerEvent): number {
  if (event.pointerType === "mouse") return Number.NaN;
  const p = event.pressure;
  return p > 0 && p < 1 && p !== 0.5 ? p : Number.NaN;
}

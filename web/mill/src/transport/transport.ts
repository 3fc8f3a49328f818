// SPDX-License-Identifier: MIT
// Play and pause, speed and clock.

import type { Row, StateFrame } from "@tribo/protocol/frames";
import type { Command } from "@tribo/protocol/messages";
import { element } from "@tribo/ui/dom";
import { clock, recall, remember } from "../page.js";
import { precise } from "../texts/figures.js";
import { t } from "../texts/texts.js";
import { Loop } from "./loop.js";
import { chosenSpeed, Hurry, TrueSpeed, WHOLE } from "./speeds.js";

// A speed that is nearer to the wanted one is not sent again.
const SAME = 0.1;

export class Transport {
  playing = false;
  /** The film sets the speed. */
  directed = false;
  // Play was pressed, and no state says so yet.
  private starts = false;
  private readonly play = element<HTMLButtonElement>("play");
  private readonly time = element<HTMLInputElement>("time");
  private readonly speed = element<HTMLSelectElement>("speed");
  private readonly skip = element<HTMLButtonElement>("skip-air");
  private readonly loopButton = element<HTMLButtonElement>("loop");
  private readonly loop: Loop;
  private loops = false;
  private readonly hurry = new Hurry();
  private readonly trueSpeed = new TrueSpeed();
  private duration = 0;
  private scrubbing = false;
  private skips = recall("skip-air") === "true";

  /** `starts` is called before the clock starts by a click. `rows`: those so far. */
  constructor(
    private readonly send: (command: Command) => void,
    starts: () => void,
    rows: () => readonly Row[],
  ) {
    this.loop = new Loop(rows);
    this.loopButton.addEventListener("click", () => {
      this.loops = !this.loops;
      this.loop.forget();
      this.loopButton.setAttribute("aria-pressed", String(this.loops));
    });
    this.play.addEventListener("click", () => {
      if (!this.playing) starts();
      this.starts = !this.playing;
      this.send({ op: this.playing ? "pause" : "play" });
    });
    this.speed.addEventListener("change", () => this.tell());
    this.time.addEventListener("input", () => (this.scrubbing = true));
    this.time.addEventListener("change", () => {
      this.scrubbing = false;
      this.seek(Number(this.time.value));
    });
    this.skip.setAttribute("aria-pressed", String(this.skips));
    this.skip.addEventListener("click", () => {
      this.skips = !this.skips;
      remember("skip-air", String(this.skips));
      this.skip.setAttribute("aria-pressed", String(this.skips));
      if (!this.skips) this.tell();
    });
  }

  begin(duration: number): void {
    this.duration = duration;
    this.loop.forget();
    this.time.max = String(duration);
    if (this.speed.value === WHOLE) this.tell();
  }
  // A source without a speed of its own begins.
  beginSource(): void {
    this.starts = false;
    this.showPlaying(false);
    if (this.speed.value !== "1" && this.speed.value !== WHOLE) this.tell();
  }

  toggle(): void {
    this.play.click();
  }
  seek(t_s: number): void {
    this.loop.forget();
    this.send({ op: "seek", t_s: Math.min(Math.max(t_s, 0), this.duration) });
  }
  seekBy(seconds: number): void {
    this.seek(Number(this.time.value) + seconds);
  }
  /** Pauses a clock that runs or is about to; returns whether it did. */
  pause(): boolean {
    if (!this.playing && !this.starts) return false;
    this.starts = false;
    this.send({ op: "pause" });
    return true;
  }

  show(state: StateFrame): void {
    const ended = this.playing && !state.playing && state.time >= this.duration - 1e-6;
    this.showPlaying(state.playing);
    if (!this.scrubbing) this.time.value = String(state.time);
    element("clock").textContent = `${clock(state.time)} / ${clock(this.duration)}`;
    if (this.skips && state.playing && !this.directed) this.hurryOn(state);
    else this.showSpeed(state.speed);
    this.showTrueSpeed(state);
    if (this.loops && (state.playing || ended)) this.goBack(state, ended);
  }

  private goBack({ time }: StateFrame, ended: boolean): void {
    const to = this.loop.next(time, ended);
    if (to === undefined) return;
    this.send({ op: "seek", t_s: to });
    if (ended) this.send({ op: "play" });
  }

  /** The chosen speed, once more. */
  tell(): void {
    this.send({ op: "speed", value: chosenSpeed(this.speed.value, this.duration) });
  }

  private showPlaying(now: boolean): void {
    if (now) this.starts = false;
    if (now === this.playing) return;
    this.playing = now;
    this.trueSpeed.stand();
    this.play.textContent = now ? t("Pause") : t("Play");
    this.play.setAttribute("aria-pressed", String(now));
    if (!now && this.skips) this.tell();
  }

  // Another viewer may have chosen it. Speeds are sent in single precision.
  private showSpeed(speed: number): void {
    if (document.activeElement === this.speed) return;
    const shown = [...this.speed.options].find(
      ({ value }) => Math.abs(chosenSpeed(value, this.duration) / speed - 1) < 1e-6,
    );
    if (shown && Math.abs(chosenSpeed(this.speed.value, this.duration) / speed - 1) > 1e-6)
      this.speed.value = shown.value;
  }

  private hurryOn({ speed, cutting }: StateFrame): void {
    const wanted = Math.min(
      chosenSpeed(this.speed.value, this.duration) * this.hurry.factor(performance.now() / 1000, cutting),
      chosenSpeed(WHOLE, Infinity),
    );
    if (Math.abs(speed / wanted - 1) > SAME) this.send({ op: "speed", value: wanted });
  }

  private showTrueSpeed({ playing, time, speed }: StateFrame): void {
    const really = playing ? this.trueSpeed.add(performance.now() / 1000, time, speed) : undefined;
    const place = element("true-speed");
    place.hidden = really === undefined;
    if (really !== undefined) place.textContent = t("runs at {speed}", { speed: precise(really, 2) });
  }
}

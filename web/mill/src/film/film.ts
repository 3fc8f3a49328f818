// SPDX-License-Identifier: MIT
// The buttons of the film. The first visit begins with its prelude; any key, a click or a button ends it.

import { element } from "@tribo/ui/dom";
import { t } from "../texts/texts.js";
import type { Director, Phase, Stage } from "./director.js";
import { declineFilm, hidePoster, isFilmNew, isStill, rememberFilm, withoutPoster } from "./first_visit.js";

const OWN_BUTTONS = "#film-buttons, #film";
// Keys that lead to the buttons, or do nothing alone.
const WAYS = new Set(["Tab", "Shift", "Control", "Alt", "Meta"]);

export interface FilmActions {
  hear(): Promise<void>;
  /** The film sets the speed of the clock, or no longer does. */
  direct(on: boolean): void;
  /** Shows the whole part before its first cut. */
  rewind(): void;
  /** What there is to do after the film. */
  invite(): void;
  say(text: string): void;
}

export class Film {
  private director: Director | undefined;
  private phase: Phase = "ended";

  constructor(
    private readonly stage: Stage,
    private readonly actions: FilmActions,
  ) {
    element("film").addEventListener("click", () => void this.play("FILM"));
    element("hear-it").addEventListener("click", () => void this.play("FILM"));
    element("skip-film").addEventListener("click", () => this.skip());
    const isOwn = (target: EventTarget | null) => target instanceof Element && target.closest(OWN_BUTTONS) !== null;
    addEventListener("pointerdown", ({ target }) => isOwn(target) || this.interrupt(), { capture: true });
    addEventListener(
      "keydown",
      ({ key, target }) => {
        const presses = isOwn(target) && (key === "Enter" || key === " ");
        if (!presses && !WAYS.has(key)) this.interrupt();
      },
      { capture: true },
    );
  }

  get plays(): boolean {
    return this.phase === "prelude" || this.phase === "plays";
  }

  /** On the first visit, where motion is welcome: the prelude, as soon as there is a part. */
  begin(): void {
    if (!isFilmNew()) return;
    const wait = () => {
      if (this.stage.state) void this.play("PRELUDE");
      else requestAnimationFrame(wait);
    };
    wait();
  }

  skip(): void {
    this.director?.skip();
  }

  /** There is no part to begin with: the page is without film and picture. */
  giveUp(): void {
    if (!this.plays) withoutPoster();
  }

  private async play(which: "PRELUDE" | "FILM"): Promise<void> {
    if (this.stage.duration === 0) return;
    // The browser asks for the gesture that is being handled.
    if (which === "FILM") void this.actions.hear();
    try {
      const shots = await import("./director.js");
      if (which === "PRELUDE" && !isFilmNew()) return;
      rememberFilm();
      this.director ??= this.open(shots.Director);
      this.director.play(shots[which], performance.now() / 1000);
    } catch {
      this.actions.say(t("The film cannot be loaded."));
    }
  }

  private open(Made: typeof Director): Director {
    const director = new Made(this.stage, isStill(), (phase) => this.tell(phase));
    const each = () => {
      director.each(performance.now() / 1000);
      requestAnimationFrame(each);
    };
    requestAnimationFrame(each);
    return director;
  }

  private tell(phase: Phase): void {
    const before = this.phase;
    this.phase = phase;
    this.actions.direct(this.plays);
    if (this.plays) document.body.dataset.film = phase;
    else delete document.body.dataset.film;
    element("film-buttons").hidden = !this.plays;
    element("hear-it").hidden = phase !== "prelude";
    if (phase !== "prelude") hidePoster();
    if (phase === "ended") this.actions.invite();
    if (phase === "skipped" && before === "prelude") this.actions.rewind();
  }

  private interrupt(): void {
    if (this.plays) this.skip();
    else if (!this.director) declineFilm();
    else if (this.phase === "ended") this.stage.glow(false);
  }
}

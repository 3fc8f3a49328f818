// SPDX-License-Identifier: MIT
// How fast the clock of the program runs: as chosen, faster through air, and as fast as the part can be milled.

/** The choice that shows the whole program in this time, s. */
export const WHOLE = "whole";
const WHOLE_S = 30;
// In the limits of the command.
const SLOWEST = 1e-6;
const FASTEST = 1000;

/** Program seconds per second of a choice. */
export function chosenSpeed(choice: string, duration: number): number {
  return choice === WHOLE ? Math.min(Math.max(duration / WHOLE_S, SLOWEST), FASTEST) : Number(choice);
}

// Through air the speed doubles each time this has passed, s, up to this factor. A short lift stays a lift.
const DOUBLES_S = 0.25;
const MOST_HURRY = 64;

/** Runs faster and faster through air. */
export class Hurry {
  private since: number | undefined;

  /** The factor on the chosen speed, `now` in s. */
  factor(now: number, cutting: boolean): number {
    if (cutting) {
      this.since = undefined;
      return 1;
    }
    this.since ??= now;
    return Math.min(2 ** ((now - this.since) / DOUBLES_S), MOST_HURRY);
  }
}

// A speed is measured over this time, s; one within this share of the wanted one counts as it.
const MEASURED_S = 1;
const REACHED = 0.85;

/** How fast the clock really runs. */
export class TrueSpeed {
  private marks: { now: number; time: number }[] = [];

  stand(): void {
    this.marks = [];
  }
  /** Returns the speed where it falls short of the wanted one; times in s. */
  add(now: number, time: number, wanted: number): number | undefined {
    const last = this.marks.at(-1);
    if (last && (time < last.time || now < last.now)) this.marks = [];
    this.marks.push({ now, time });
    while (this.marks.length > 2 && now - this.marks[1]!.now >= MEASURED_S) this.marks.shift();
    const first = this.marks[0]!;
    if (now - first.now < MEASURED_S) return undefined;
    const speed = (time - first.time) / (now - first.now);
    return speed < REACHED * wanted ? speed : undefined;
  }
}

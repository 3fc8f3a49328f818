// SPDX-License-Identifier: MIT
// Where something goes wrong along the program.

export type Event = "damage" | "overload" | "rubbing";
export interface Happened {
  time: number;
  what: Event;
}

// Events of one kind that are nearer belong together; a stretch that begins so soon is the one here; s.
const TOGETHER_S = 1;
const HERE_S = 0.05;

/** When the next stretch with a problem begins; after the last one, the first. Teeth that rub count where nothing worse is. */
export function nextProblem(events: readonly Happened[], time: number): Happened | undefined {
  const worse = events.filter(({ what }) => what !== "rubbing");
  const sorted = (worse.length > 0 ? worse : [...events]).sort((a, b) => a.time - b.time);
  const last = new Map<Event, number>();
  const begins = sorted.filter((event) => {
    const before = last.get(event.what) ?? -Infinity;
    last.set(event.what, event.time);
    return event.time - before > TOGETHER_S;
  });
  return begins.find((event) => event.time > time + HERE_S) ?? begins[0];
}

// SPDX-License-Identifier: MIT
// Places to inspect, the state of the servo, and the assumptions.

import type { JobFrame, ServoFrame } from "@tribo/protocol/frames";
import type { FileFault } from "@tribo/protocol/messages";
import { element } from "@tribo/ui/dom";

const MOST_LISTED = 100;

// Places in the program that need attention; a click goes there. After the first hundred only their number is shown.
export class LineList<Place extends { line: number }> {
  private readonly box: HTMLElement;
  private readonly list: HTMLOListElement;
  private readonly rest = document.createElement("p");
  private more = 0;

  constructor(
    id: string,
    private readonly go: (place: Place) => void,
  ) {
    this.box = element(id);
    this.list = this.box.querySelector("ol")!;
    this.box.append(this.rest);
    this.clear();
  }

  clear(): void {
    this.list.replaceChildren();
    this.rest.textContent = "";
    this.more = 0;
    this.box.hidden = true;
  }
  add(place: Place, what: string): void {
    if (this.list.childElementCount === MOST_LISTED) {
      this.rest.textContent = `and ${++this.more} more`;
      return;
    }
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = `line ${place.line}: ${what}`;
    button.addEventListener("click", () => this.go(place));
    item.append(button);
    this.list.append(item);
    this.box.hidden = false;
  }
}

export function showServo(frame: ServoFrame): void {
  const list = element("servo");
  list.hidden = false;
  const rows: [string, string][] = [
    ["rate", `${frame.rate.toFixed(0)} Hz`],
    ["ticks", String(frame.ticks)],
    ["late", String(frame.late)],
    ["lateness p99", `${frame.lateness[1].toFixed(0)} µs`],
    ["lateness max", `${frame.lateness[3].toFixed(0)} µs`],
    ["tick p99", `${frame.cpu[1].toFixed(0)} µs`],
    ["force limit", `${frame.limit.toFixed(1)} N`],
    ["largest force", `${frame.largest.toFixed(2)} N`],
    ...(frame.fault ? ([["fault", frame.fault]] as [string, string][]) : []),
  ];
  list.replaceChildren(
    ...rows.map(([name, value]) => {
      const row = document.createElement("div");
      const term = document.createElement("dt");
      const said = document.createElement("dd");
      term.textContent = name;
      said.textContent = value;
      row.append(term, said);
      return row;
    }),
  );
}

// Shown until the files are good again, also beside other messages.
export function showFileFault(wrong: FileFault | null): void {
  const place = wrong ? [wrong.file, wrong.line, wrong.column].filter(Boolean).join(":") : "";
  const parts = wrong ? [[place, wrong.why].filter(Boolean).join(": "), wrong.remedy, "the cut before goes on"] : [];
  element("file-fault").hidden = wrong === null;
  element("file-fault").textContent = parts.filter(Boolean).join("; ");
}

// What the engine assumed, and what the picture adds.
export class Assumed {
  private told: string[] = [];
  private drawn: string[] = [];

  tell(warnings: string[]): void {
    this.told = warnings;
    this.show();
  }
  draw(job: JobFrame): void {
    const without = job.cutters.filter(({ holder }) => holder.length === 0).map(({ number }) => `T${number}`);
    this.drawn =
      without.length > 0
        ? [`The job has no holder for ${without.join(", ")}: the one in the picture is not checked.`]
        : [];
    this.show();
  }

  private show(): void {
    const all = [...this.told, ...this.drawn];
    element("said").hidden = all.length === 0;
    element("warnings").replaceChildren(
      ...all.map((text) => {
        const item = document.createElement("li");
        item.textContent = text;
        return item;
      }),
    );
  }
}

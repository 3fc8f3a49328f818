// SPDX-License-Identifier: MIT
// Places to inspect, the state of the servo, and the assumptions.

import type { JobFrame, ServoFrame } from "@tribo/protocol/frames";
import type { FileFault } from "@tribo/protocol/messages";
import { element } from "@tribo/ui/dom";
import type { ChipMark } from "../sight/heat_map.js";
import { fixed, lengthWords } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";

const MOST_LISTED = 100;

// Places in the program that need attention; a click goes there. After the first hundred only their number is shown.
export class LineList<Place extends { line: number }> {
  private readonly box: HTMLElement;
  private readonly list: HTMLOListElement;
  private readonly rest = document.createElement("p");
  private more = 0;

  /** Shorter lists are not shown. */
  constructor(
    id: string,
    private readonly go: (place: Place) => void,
    private readonly least = 1,
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
      this.rest.textContent = t("and {count} more", { count: ++this.more });
      return;
    }
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = t("line {line}: {what}", { line: place.line, what });
    button.addEventListener("click", () => this.go(place));
    item.append(button);
    this.list.append(item);
    this.box.hidden = this.list.childElementCount < this.least;
  }
}

/** The lines with chips out of range. */
export class ChipList {
  private readonly list: LineList<ChipMark>;
  private listed = "";

  constructor(go: (mark: ChipMark) => void) {
    this.list = new LineList<ChipMark>("chips", go);
  }
  show(marks: readonly ChipMark[]): void {
    const said = marks.map(({ verdict, chip }) =>
      [verdict === "rubbing" ? t("rubs") : t("overload"), lengthWords(chip, 3)].join(", "),
    );
    const now = marks.map(({ line }, n) => `${line} ${said[n]}`).join();
    if (now === this.listed) return;
    this.listed = now;
    this.list.clear();
    marks.forEach((mark, n) => this.list.add(mark, said[n]!));
  }
}

export function showServo(frame: ServoFrame): void {
  const list = element("servo");
  list.hidden = false;
  const rows: [string, string][] = [
    [word("rate"), `${fixed(frame.rate, 0)} Hz`],
    [word("ticks"), String(frame.ticks)],
    [word("late"), String(frame.late)],
    [word("lateness p99"), `${fixed(frame.lateness[1], 0)} µs`],
    [word("lateness max"), `${fixed(frame.lateness[3], 0)} µs`],
    [word("tick p99"), `${fixed(frame.cpu[1], 0)} µs`],
    [word("force limit"), `${fixed(frame.limit, 1)} N`],
    [word("largest force"), `${fixed(frame.largest, 2)} N`],
    ...(frame.fault ? ([[word("fault"), frame.fault]] as [string, string][]) : []),
  ];
  list.replaceChildren(
    ...rows.map(([name, value]) => {
      const row = document.createElement("div");
      const term = document.createElement("dt");
      const said = document.createElement("dd");
      term.textContent = t(name);
      said.textContent = value;
      row.append(term, said);
      return row;
    }),
  );
}

// Shown until the files are good again, also beside other messages.
export function showFileFault(wrong: FileFault | null): void {
  const place = wrong ? [wrong.file, wrong.line, wrong.column].filter(Boolean).join(":") : "";
  const parts = wrong ? [[place, wrong.why].filter(Boolean).join(": "), wrong.remedy, t("the cut before goes on")] : [];
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
        ? [
            t("The job has no holder for {tools}: the one in the picture is not checked.", {
              tools: without.join(", "),
            }),
          ]
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

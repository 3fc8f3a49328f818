// SPDX-License-Identifier: MIT
// The text of the program with the load of each line. The line at the clock is marked; a click on a line goes to it.

import type { PathFrame, ProgramFrame, Row } from "@tribo/protocol/frames";
import { element } from "@tribo/ui/dom";
import { oncePerFrame } from "@tribo/ui/frame";
import { heat } from "../sight/heat.js";
import { css } from "../sight/legend.js";
import { fixed } from "../texts/figures.js";
import { t } from "../texts/texts.js";

const LINE_PX = 20;
// At the very time at which a line begins the one before it ends.
const INTO_S = 1e-3;
// Lines that are drawn beyond the window.
const AROUND = 8;

/** When each line first runs: the times at which the ways to its points begin, s. */
export function lineTimes({ times, lines }: Pick<PathFrame, "times" | "lines">): Map<number, number> {
  const first = new Map<number, number>();
  lines.forEach((line, n) => {
    if (!first.has(line)) first.set(line, times[Math.max(n - 1, 0)]!);
  });
  return first;
}

/** The largest peak force of each line. */
export class LineLoads {
  private readonly most = new Map<number, number>();
  largest = 0;

  clear(): void {
    this.most.clear();
    this.largest = 0;
  }
  add(rows: readonly Row[]): void {
    for (const { line, peakForce } of rows) {
      if (!(peakForce > (this.most.get(line) ?? 0))) continue;
      this.most.set(line, peakForce);
      this.largest = Math.max(this.largest, peakForce);
    }
  }
  // A share of the largest.
  of(line: number): number {
    return this.largest > 0 ? (this.most.get(line) ?? 0) / this.largest : 0;
  }
  force(line: number): number {
    return this.most.get(line) ?? 0;
  }
}

export class Program {
  private readonly box = element("program");
  private readonly list = element("program-lines");
  private readonly drawn = element("program-drawn");
  private readonly loads = new LineLoads();
  // Of the lines in the window.
  private readonly items = new Map<number, HTMLElement>();
  private lines: string[] = [];
  private times = new Map<number, number>();
  private now = 0;
  private chosen = 0;
  private glowing = 0;
  private readonly draw = oncePerFrame(() => this.paint());
  // Until then the user reads elsewhere, ms.
  private readsUntil = 0;

  constructor(private readonly go: (time: number) => void) {
    this.list.addEventListener("scroll", () => this.draw());
    for (const kind of ["wheel", "pointerdown"] as const)
      this.list.addEventListener(kind, () => (this.readsUntil = performance.now() + 5000), { passive: true });
    this.list.addEventListener("click", ({ target }) => {
      const line = (target as HTMLElement).closest<HTMLElement>("[data-line]")?.dataset.line;
      if (line) this.choose(Number(line));
    });
    this.list.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -1, ArrowDown: 1, PageUp: -20, PageDown: 20 }[event.key];
      if (step) this.mark((this.chosen || this.now) + step);
      else if (event.key === "Enter") this.choose(this.chosen || this.now);
      else return;
      event.preventDefault();
    });
    // A list that was hidden begins at its top again.
    new ResizeObserver(() => {
      this.follow();
      this.draw();
    }).observe(this.list);
  }

  begin(): void {
    this.lines = [];
    this.times.clear();
    this.loads.clear();
    this.now = this.chosen = this.glowing = 0;
    this.forgetLines();
    this.box.hidden = true;
  }
  private forgetLines(): void {
    this.items.clear();
    this.drawn.replaceChildren();
  }
  take({ name, text }: ProgramFrame): void {
    this.box.hidden = false;
    this.forgetLines();
    this.lines = text.replace(/\r?\n$/, "").split(/\r\n|\n|\r/);
    element("program-name").textContent = name.replace(/^.*\//, "");
    element("program-note").hidden = text !== "";
    this.list.hidden = text === "";
    this.draw();
  }
  takePath(frame: PathFrame): void {
    this.times = lineTimes(frame);
  }
  forgetRows(): void {
    this.loads.clear();
    this.draw();
  }
  addRows(rows: readonly Row[]): void {
    this.loads.add(rows);
    this.draw();
  }

  show(line: number): void {
    if (line === this.now) return;
    this.now = line;
    this.follow();
    this.draw();
  }
  private follow(): void {
    if (performance.now() > this.readsUntil) this.reveal(this.glowing || this.now);
  }

  // Marks a line, and shows it; 0: none.
  glow(line: number): void {
    this.glowing = line;
    if (line > 0) this.reveal(line);
    this.draw();
  }

  private mark(line: number): void {
    this.chosen = Math.min(Math.max(line, 1), this.lines.length);
    this.readsUntil = performance.now() + 5000;
    this.reveal(this.chosen);
    this.draw();
  }
  // Goes to a line.
  choose(line: number): void {
    this.chosen = line;
    const time = this.times.get(line) ?? this.nextTime(line);
    if (time !== undefined) this.go(time + INTO_S);
    this.draw();
  }
  // Of the next line that moves.
  private nextTime(line: number): number | undefined {
    for (let n = line + 1; n <= this.lines.length; ++n) if (this.times.has(n)) return this.times.get(n);
    return undefined;
  }

  private reveal(line: number): void {
    const { clientHeight, scrollTop } = this.list;
    const top = (line - 1) * LINE_PX;
    if (top < scrollTop + 2 * LINE_PX || top > scrollTop + clientHeight - 3 * LINE_PX)
      this.list.scrollTop = top - clientHeight / 2;
  }

  private paint(): void {
    const { scrollTop, clientHeight } = this.list;
    if (clientHeight === 0) return;
    const from = Math.max(Math.floor(scrollTop / LINE_PX) - AROUND, 0);
    const to = Math.min(Math.ceil((scrollTop + clientHeight) / LINE_PX) + AROUND, this.lines.length);
    this.drawn.style.height = `${this.lines.length * LINE_PX}px`;
    for (const [line, item] of this.items) {
      if (line > from && line <= to) continue;
      item.remove();
      this.items.delete(line);
    }
    // A line stays the same element: a browser forgets the click on one that is replaced while the button is down.
    let below: HTMLElement | null = null;
    for (let line = to; line > from; --line) {
      let item = this.items.get(line);
      if (!item) {
        item = this.item(line);
        this.items.set(line, item);
        this.drawn.insertBefore(item, below);
      }
      below = item;
      item.classList.toggle("chosen", line === this.chosen);
      item.classList.toggle("glows", line === this.glowing);
      item.ariaSelected = String(line === this.now);
      this.showLoad(item, line);
    }
    const marked = this.chosen || this.now;
    if (marked > from && marked <= to) this.list.setAttribute("aria-activedescendant", `program-line-${marked}`);
    else this.list.removeAttribute("aria-activedescendant");
  }

  private item(line: number): HTMLElement {
    const item = document.createElement("div");
    item.role = "option";
    item.id = `program-line-${line}`;
    item.dataset.line = String(line);
    item.style.top = `${(line - 1) * LINE_PX}px`;
    item.ariaPosInSet = String(line);
    item.ariaSetSize = String(this.lines.length);
    item.append(cell("b", String(line)), cell("span", this.lines[line - 1] || " "));
    return item;
  }

  private showLoad(item: HTMLElement, line: number): void {
    const share = this.loads.of(line);
    let track = item.querySelector("u");
    if (!(share > 0)) return track?.remove();
    if (!track) {
      track = cell("u", "");
      track.append(cell("i", ""));
      item.append(track);
    }
    track.title = t("peak force {force} N", { force: fixed(this.loads.force(line), 0) });
    const bar = track.querySelector("i")!;
    bar.style.width = `${Math.max(100 * share, 3)}%`;
    bar.style.background = css(heat(share));
  }
}

function cell(tag: "b" | "i" | "span" | "u", text: string): HTMLElement {
  const made = document.createElement(tag);
  made.textContent = text;
  return made;
}

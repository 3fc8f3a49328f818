// SPDX-License-Identifier: MIT
// "Learn by ear": the window of the quiz. What is asked stands nowhere in it before it is answered.

import "./learn.css";
import { element } from "@tribo/ui/dom";
import { t, translate, word } from "../texts/texts.js";
import type { Order } from "../sources/workshop.js";
import { RATE } from "./clip.js";
import { filesOf, FLUTES, JOB_NAME, orderOf, RIGHT_CUT, spanOf, SPINDLE_RPM, WRONG_CUTS, type Cut } from "./cuts.js";
import type { FromMill, Listened, ToMill } from "./learn_worker.js";
import { cellsOf, COLUMNS } from "./cells.js";
import { Player } from "./player.js";
import { Round } from "./quiz.js";
import { drawSpectra } from "./spectra.js";

const WINDOW = `
<header>
  <h2 id="quiz-title">What is wrong with this cut?</h2>
  <button id="quiz-close" type="button" aria-label="Close the quiz">✕</button>
</header>
<p>The same job is milled eight times: once as it should be, and seven times with one thing wrong. Listen to both, with
  headphones if you have some, and say what it is.</p>
<div id="quiz-asks">
  <p id="quiz-count" role="status"></p>
  <div id="quiz-ears">
    <button id="quiz-right" type="button" aria-pressed="false"></button>
    <button id="quiz-this" type="button" aria-pressed="false"></button>
  </div>
  <div id="quiz-answers" role="group" aria-label="What is wrong"></div>
  <section id="quiz-told" aria-labelledby="quiz-verdict" hidden>
    <h3 id="quiz-verdict" tabindex="-1"></h3>
    <p id="quiz-why"></p>
    <div class="buttons">
      <button id="quiz-next" type="button"></button>
      <button id="quiz-mill" type="button" title="Opens this cut on the bench, to see and to feel it">Mill it here</button>
    </div>
    <canvas id="quiz-spectra" role="img" aria-label="Levels over frequency: the right cut as a surface, this cut as a line"></canvas>
    <div id="quiz-heard" class="quiz-table"></div>
  </section>
</div>
<section id="quiz-ends" aria-labelledby="quiz-score" hidden>
  <h3 id="quiz-score" tabindex="-1"></h3>
  <p>Listen again to what you know now. Levels are dB under full scale.</p>
  <div id="quiz-all" class="quiz-table"></div>
  <div class="buttons"><button id="quiz-again" type="button">Again</button></div>
</section>`;

const EARS = { "quiz-right": word("The right cut"), "quiz-this": word("This cut") } as const;

/** Rows of cells; the first of a row and all of the first row are heads. */
function table(rows: (string | HTMLElement)[][]): HTMLTableElement {
  const made = document.createElement("table");
  rows.forEach((cells, y) => {
    const row = made.insertRow();
    cells.forEach((content, x) => {
      const cell = document.createElement(x === 0 || y === 0 ? "th" : "td");
      if (x === 0 || y === 0) cell.scope = y === 0 ? "col" : "row";
      cell.append(content);
      row.append(cell);
    });
  });
  return made;
}

export class Learn {
  private readonly window = document.createElement("dialog");
  private readonly worker = new Worker(new URL("./learn_worker.ts", import.meta.url), { type: "module" });
  private readonly asked: Cut[] = [];
  private readonly listened = new Map<Cut, Listened>();
  private readonly player = new Player((key) => this.showPlaying(key));
  private round = new Round(WRONG_CUTS);
  private fault = "";

  /** `mill` opens a cut on the bench. */
  constructor(private readonly mill: (order: Order) => void) {
    this.window.id = "quiz";
    this.window.setAttribute("aria-labelledby", "quiz-title");
    this.window.innerHTML = WINDOW;
    translate(this.window);
    document.body.append(this.window);
    for (const cut of WRONG_CUTS) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = t(cut.name);
      button.addEventListener("click", () => this.answer(cut));
      element("quiz-answers").append(button);
    }
    element("quiz-right").addEventListener("click", () => this.play(RIGHT_CUT, "quiz-right"));
    element("quiz-this").addEventListener("click", () => this.play(this.round.cut, "quiz-this"));
    element("quiz-next").addEventListener("click", () => {
      this.round.next();
      this.show();
      element(this.round.cut ? "quiz-this" : "quiz-score").focus();
    });
    element("quiz-mill").addEventListener("click", () => {
      const { cut } = this.round;
      this.window.close();
      if (cut) this.mill(orderOf(cut));
    });
    element("quiz-again").addEventListener("click", () => {
      this.round = new Round(WRONG_CUTS);
      this.show();
      element("quiz-this").focus();
    });
    element("quiz-close").addEventListener("click", () => this.window.close());
    this.window.addEventListener("close", () => this.player.stop());
    new ResizeObserver(() => this.draw()).observe(element("quiz-spectra"));
    this.worker.onmessage = ({ data }: MessageEvent<FromMill>) => this.take(data);
    this.worker.onerror = ({ message }) => this.take({ why: message || t("the script is not there") });
    for (const cut of [RIGHT_CUT, ...this.round.cuts]) this.ask(cut);
  }

  open(): void {
    this.show();
    this.window.showModal();
  }

  private ask(cut: Cut): void {
    this.asked.push(cut);
    const message: ToMill = {
      files: filesOf(cut),
      job: JOB_NAME,
      span: spanOf(cut),
      spindleHz: SPINDLE_RPM / 60,
      flutes: FLUTES,
    };
    this.worker.postMessage(message);
  }

  private take(message: FromMill): void {
    const cut = this.asked.shift();
    if ("why" in message) this.fault = t("The cuts cannot be milled here: {why}.", { why: message.why });
    else if (cut) this.listened.set(cut, message);
    this.showReady();
  }

  private play(cut: Cut | undefined, key: string): void {
    const listened = cut && this.listened.get(cut);
    if (listened) this.player.toggle(key, listened.clip);
  }
  private showPlaying(key: string | undefined): void {
    for (const button of this.window.querySelectorAll<HTMLElement>("[aria-pressed]"))
      button.setAttribute("aria-pressed", String(button.id === key));
  }

  private answer(cut: Cut): void {
    this.round.answer(cut.id);
    this.show();
    element("quiz-verdict").focus();
  }

  private get buttons(): HTMLButtonElement[] {
    return [...element("quiz-answers").querySelectorAll("button")];
  }

  /** Nothing of a cut before stays in the page. */
  private forget(): void {
    for (const id of ["quiz-verdict", "quiz-why", "quiz-heard", "quiz-next", "quiz-score", "quiz-all"])
      element(id).replaceChildren();
    const spectra = element<HTMLCanvasElement>("quiz-spectra");
    spectra.width = spectra.height = 0;
  }

  private show(): void {
    this.player.stop();
    this.forget();
    const { cut, answered } = this.round;
    element("quiz-asks").hidden = !cut;
    element("quiz-ends").hidden = cut !== undefined;
    element("quiz-told").hidden = !answered;
    this.buttons.forEach((button, n) => {
      const offered = WRONG_CUTS[n]!;
      const said = answered && this.round.answers.at(-1) === offered.id;
      button.className = !answered ? "" : offered === cut ? "right" : said ? "wrong" : "";
    });
    if (!cut) this.showEnd();
    else if (answered) this.tell(cut);
    this.showReady();
  }

  /** How far the quiz is, and what can be heard. */
  private showReady(): void {
    const { cut, number, answered, score, answers, cuts } = this.round;
    if (!cut) return;
    const ready = { "quiz-right": this.listened.has(RIGHT_CUT), "quiz-this": this.listened.has(cut) };
    for (const id of ["quiz-right", "quiz-this"] as const) {
      const button = element<HTMLButtonElement>(id);
      button.disabled = !ready[id];
      button.textContent = t(EARS[id]);
    }
    const can = ready["quiz-right"] && ready["quiz-this"];
    for (const button of this.buttons) button.disabled = !can || answered;
    const said = { number, of: cuts.length, score, answers: answers.length };
    const count =
      answers.length > 0
        ? t("Cut {number} of {of}, {score} of {answers} right so far.", said)
        : t("Cut {number} of {of}.", said);
    element("quiz-count").textContent = can ? count : `${count} ${this.fault || t("It is being milled ...")}`;
  }

  private tell(cut: Cut): void {
    const right = this.round.answers.at(-1) === cut.id;
    element("quiz-verdict").textContent = right
      ? t("Right: {cut}.", { cut: t(cut.name) })
      : t("No, it was: {cut}.", { cut: t(cut.name) });
    element("quiz-why").textContent = t(cut.why);
    element("quiz-next").textContent = this.round.number < this.round.cuts.length ? t("Next cut") : t("Score");
    const columns = [RIGHT_CUT, cut].map((of) => cellsOf(this.listened.get(of)!.heard));
    const rows = COLUMNS.map((name, n) => [t(name), columns[0]![n]!, columns[1]![n]!]);
    element("quiz-heard").replaceChildren(table([["dB", t("right cut"), t("this cut")], ...rows]));
    this.draw();
  }

  private draw(): void {
    const { cut, answered } = this.round;
    const right = this.listened.get(RIGHT_CUT);
    const wrong = cut && answered ? this.listened.get(cut) : undefined;
    if (right && wrong) drawSpectra(element<HTMLCanvasElement>("quiz-spectra"), right.powers, wrong.powers, RATE);
  }

  private showEnd(): void {
    const { score, cuts, answers } = this.round;
    element("quiz-score").textContent = t("{score} of {of} right", { score, of: cuts.length });
    const rows = [RIGHT_CUT, ...WRONG_CUTS].map((cut) => {
      const button = document.createElement("button");
      button.type = "button";
      button.id = `quiz-hear-${cut.id}`;
      button.textContent = t(cut.name);
      button.setAttribute("aria-pressed", "false");
      button.addEventListener("click", () => this.play(cut, button.id));
      const at = cuts.indexOf(cut);
      const said =
        at < 0 ? "" : answers[at] === cut.id ? t("right") : t(WRONG_CUTS.find(({ id }) => id === answers[at])!.name);
      return [button as string | HTMLElement, said].concat(cellsOf(this.listened.get(cut)!.heard));
    });
    element("quiz-all").replaceChildren(table([[t("cut"), t("you said"), ...COLUMNS.map((name) => t(name))], ...rows]));
  }
}

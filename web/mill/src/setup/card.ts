// SPDX-License-Identifier: MIT
// The set-up of the cut, for the mill of the page: the job as a form and as text, milled again as it is changed.

import { download, element } from "@tribo/ui/dom";
import { feedUnit, fromField, lengthUnit, onUnit, toField } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import type { SetUp } from "../sources/workshop.js";
import { boxOf, moved, textOf, type Box } from "./stock_box.js";
import { clampingOf, withClamping, withZero, zeroOf, type Clamping } from "./chain.js";
import { Undo } from "./undo.js";
import { entriesOf, quoted, unquoted, withKey, withoutLine, withValue, type Entry } from "./job_text.js";

interface Field {
  table: string;
  key: string;
  label: string;
  unit?: () => string;
}
const NUMBERS: Field[] = [
  { table: "cutter", key: "diameter_mm", label: word("diameter"), unit: lengthUnit },
  { table: "cutter", key: "flutes", label: word("flutes") },
  { table: "cutter", key: "length_mm", label: word("length of edges"), unit: lengthUnit },
  { table: "cutter", key: "stickout_mm", label: word("stick-out"), unit: lengthUnit },
  { table: "process", key: "spindle_rpm", label: word("spindle"), unit: () => t("rpm") },
  { table: "process", key: "feed_mm_per_min", label: word("feed"), unit: feedUnit },
];

export interface Known extends SetUp {
  name: string; // of the job file
  /** The jobs of a chain of set-ups, of which it is one. */
  chain: string[];
}

const CLAMPINGS: Record<Clamping, string> = {
  same: word("as before"),
  "over x": word("turned over about x"),
  "over y": word("turned over about y"),
  other: word("as the text says"),
};

function labelled(label: string, input: HTMLElement, unit = ""): HTMLElement {
  const box = document.createElement("label");
  const value = document.createElement("span");
  value.append(input, unit && ` ${unit}`);
  box.append(label, value);
  return box;
}

function number(value: string, changed: (value: string) => void): HTMLInputElement {
  const input = document.createElement("input");
  input.type = "number";
  input.step = "any";
  input.value = value;
  input.addEventListener("change", () => {
    if (Number.isFinite(input.valueAsNumber)) changed(String(input.valueAsNumber));
  });
  return input;
}

const plain = (raw: string) => raw.replaceAll("_", "");
const isLength = ({ key }: Field) => /_mm(_per_min)?$/.test(key);
// `raw` and what is changed are millimetres.
function lengthField(raw: string, changed: (raw: string) => void): HTMLInputElement {
  return number(toField(Number(plain(raw))), (value) => changed(String(fromField(Number(value)))));
}

export function choice(values: string[], now: string, changed: (value: string) => void): HTMLSelectElement {
  const select = document.createElement("select");
  for (const value of values.includes(now) ? values : [now, ...values]) {
    const option = document.createElement("option");
    option.value = value;
    option.textContent = value || t("none");
    select.append(option);
  }
  select.value = now;
  select.addEventListener("change", () => changed(select.value));
  return select;
}

export class SetUpCard {
  private known: Known | undefined;
  private name = ""; // of the last one
  // Texts that were milled before.
  private readonly before: string[] = [];
  private readonly text = element<HTMLTextAreaElement>("job-text");
  private readonly back = element<HTMLButtonElement>("setup-back");
  private readonly undoButton = element<HTMLButtonElement>("setup-undo");
  private readonly redoButton = element<HTMLButtonElement>("setup-redo");
  // Of the text, since the job was milled.
  private undo = new Undo("");

  /**
   * `run` mills this job in place of the one here; it returns whether it was taken. `stock` is called with the box of the
   * stock whenever it may have changed; undefined: there is none to set up. `turnTo` shows another job of the chain.
   */
  constructor(
    private readonly run: (text: string) => Promise<boolean>,
    private readonly stock: (box: Box | undefined) => void,
    private readonly turnTo: (name: string) => void,
  ) {
    this.text.addEventListener("change", () => this.change(this.text.value));
    this.undoButton.addEventListener("click", () => this.restore(this.undo.undo()));
    this.redoButton.addEventListener("click", () => this.restore(this.undo.redo()));
    addEventListener("keydown", (event) => this.listenToUndo(event));
    onUnit(() => this.build());
    element("mill-again").addEventListener("click", () => void this.again());
    this.back.addEventListener("click", () => void this.goBack());
    element("save-job").addEventListener("click", () => {
      if (this.known) download(new Blob([this.text.value], { type: "application/toml" }), this.known.name);
    });
  }

  /** Of the job that is milled now; undefined: it has none here. */
  show(known: Known | undefined): void {
    // Told again: what is edited stays.
    if (known && known.name === this.known?.name && known.text === this.known.text) return;
    this.known = known;
    element("setup-card").hidden = known === undefined;
    if (!known) return this.stock(undefined);
    if (known.name !== this.name) this.before.length = 0;
    this.name = known.name;
    this.set(known.text);
  }

  private async again(): Promise<void> {
    if (!this.known || this.text.value === this.known.text) return;
    this.before.push(this.known.text);
    if (!(await this.run(this.text.value))) this.before.pop();
  }
  // What was changed is milled, so that nothing is lost.
  private async turn(to: string): Promise<void> {
    await this.again();
    this.turnTo(to);
  }
  private async goBack(): Promise<void> {
    const text = this.before.pop();
    if (text !== undefined && !(await this.run(text))) this.before.push(text);
  }

  private set(text: string): void {
    this.back.disabled = this.before.length === 0;
    this.undo = new Undo(text);
    this.restore(text);
  }
  // The form follows the text, and the text the form.
  private change(text: string): void {
    this.undo.commit(text);
    this.restore(text);
  }
  private restore(text: string): void {
    this.text.value = text;
    this.undoButton.disabled = !this.undo.canUndo;
    this.redoButton.disabled = !this.undo.canRedo;
    this.build();
  }

  /** Another box of the stock; it can be undone when it is `done`. */
  stretch(box: Box, done: boolean): void {
    const entry = this.stockEntry();
    if (!entry) return;
    const text = withValue(this.text.value, entry.line, textOf(box));
    if (done) this.change(text);
    else this.restore(text);
  }
  /** Says which box the stock has. */
  tellStock(): void {
    // The picture is in the coordinates of the last set-up.
    const isLast = this.known !== undefined && [this.known.name, undefined].includes(this.known.chain.at(-1));
    const entry = isLast ? this.stockEntry() : undefined;
    this.stock(entry && boxOf(entry.raw));
  }
  private stockEntry(): Entry | undefined {
    return entriesOf(this.text.value).find(({ table, key }) => table === "stock" && key === "box_mm");
  }

  // In the text the browser undoes single letters.
  private listenToUndo(event: KeyboardEvent): void {
    const away = element("setup-card").offsetParent === null || event.target === this.text;
    if (away || !(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    if (key === "y" || (key === "z" && event.shiftKey)) this.redoButton.click();
    else if (key === "z") this.undoButton.click();
    else return;
    event.preventDefault();
  }

  private build(): void {
    const { known } = this;
    if (!known) return;
    const text = this.text.value;
    const entries = entriesOf(text);
    const fields: HTMLElement[] = [];
    const put = (entry: Entry) => (raw: string) => this.change(withValue(text, entry.line, raw));
    const find = (table: string, key: string) => entries.find((e) => e.table === table && e.key === key);

    if (known.chain.length > 1)
      fields.push(
        labelled(
          t("set-up"),
          choice(known.chain, known.name, (to) => void this.turn(to)),
        ),
      );
    if (find("stock", "from")) fields.push(...this.clamping(text));
    const material = find("material", "name");
    const named = material && unquoted(material.raw);
    if (material && named !== undefined)
      fields.push(
        labelled(
          t("material"),
          choice(known.materials, named, (to) => put(material)(quoted(to))),
        ),
      );
    const machine = find("path", "machine");
    const now = machine ? unquoted(machine.raw) : "";
    if (now !== undefined && find("path", "gcode"))
      fields.push(
        labelled(
          t("machine"),
          choice(["", ...known.machines], now, (to) =>
            this.change(
              to || !machine ? withKey(text, "path", "machine", quoted(to)) : withoutLine(text, machine.line),
            ),
          ),
        ),
      );
    this.tellStock();
    const stock = this.stockEntry();
    const box = stock && boxOf(stock.raw);
    if (stock && box) fields.push(...this.corners(box, put(stock)));
    for (const field of NUMBERS)
      for (const entry of entries.filter((e) => e.table === field.table && e.key === field.key)) {
        const which = field.table === "cutter" ? this.cutterName(entries, entry) : "";
        const input = isLength(field) ? lengthField(entry.raw, put(entry)) : number(plain(entry.raw), put(entry));
        const shown = labelled(`${which}${t(field.label)}`, input, field.unit?.());
        shown.dataset.order = String(field.table === "cutter" ? entry.nth : 1000);
        fields.push(shown);
      }
    // The fields of one cutter together.
    fields.sort((a, b) => Number(a.dataset.order ?? -1) - Number(b.dataset.order ?? -1));
    // Another field may have the focus while a value is taken.
    const focus = [...element("setup-form").querySelectorAll("input, select")].indexOf(document.activeElement!);
    element("setup-form").replaceChildren(...fields);
    if (focus >= 0) element("setup-form").querySelectorAll<HTMLElement>("input, select")[focus]?.focus();
  }

  // How it stands in the stock of the earlier set-up.
  private clamping(text: string): HTMLElement[] {
    const now = clampingOf(text);
    const select = document.createElement("select");
    for (const [value, words] of Object.entries(CLAMPINGS) as [Clamping, string][])
      if (value !== "other" || now === "other") select.add(new Option(t(words), value));
    select.value = now;
    select.addEventListener("change", () => this.change(withClamping(text, select.value as Clamping)));
    const zero = zeroOf(text);
    const fields = (["x", "y", "z"] as const).flatMap((name, n) => {
      if (!zero) return [];
      const field = lengthField(String(zero[n]), (value) =>
        this.change(
          withZero(
            text,
            zero.map((mm, k) => (k === n ? Number(value) : mm)),
          ),
        ),
      );
      return [labelled(t("zero {axis}", { axis: name }), field, lengthUnit())];
    });
    return [labelled(t("clamped"), select), ...fields];
  }

  private corners(box: Box, put: (raw: string) => void): HTMLElement[] {
    return (["x", "y", "z"] as const).map((name, n) => {
      const axis = n as 0 | 1 | 2;
      const field = (end: 0 | 1) =>
        lengthField(String(box[end][axis]), (value) =>
          put(textOf(moved(box, { end, axis }, Number(value), -Infinity))),
        );
      const [low, high] = [field(0), field(1)];
      low.ariaLabel = t("stock from {axis}", { axis: name });
      high.ariaLabel = t("stock to {axis}", { axis: name });
      const both = document.createElement("span");
      both.append(low, ` ${t("to")} `, high, ` ${lengthUnit()}`);
      const row = document.createElement("div");
      row.className = "corner";
      row.append(t("stock {axis}", { axis: name }), both);
      return row;
    });
  }

  private cutterName(entries: readonly Entry[], { nth }: Entry): string {
    const mine = (key: string) => entries.find((e) => e.table === "cutter" && e.nth === nth && e.key === key)?.raw;
    const called = mine("number");
    return called
      ? `T${called} `
      : entries.some((e) => e.table === "cutter" && e.nth > 0)
        ? `${t("{number}. cutter", { number: nth + 1 })} `
        : "";
  }
}

// SPDX-License-Identifier: MIT
// The set-up of the cut, for the mill of the page: the job as a form and as text, milled again as it is changed.

import { download, element } from "@tribo/ui/dom";
import { feedUnit, fromField, lengthUnit, onUnit, toField } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import type { SetUp } from "../sources/workshop.js";
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
  { table: "process", key: "spindle_rpm", label: word("spindle"), unit: () => "rpm" },
  { table: "process", key: "feed_mm_per_min", label: word("feed"), unit: feedUnit },
];
const BOX = /^\[\s*\[([^[\]]*)\]\s*,\s*\[([^[\]]*)\]\s*\]$/;

export interface Known extends SetUp {
  name: string; // of the job file
}

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

  /** `run` mills this job in place of the one here; it returns whether it was taken. */
  constructor(private readonly run: (text: string) => Promise<boolean>) {
    this.text.addEventListener("change", () => this.build());
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
    if (!known) return;
    if (known.name !== this.name) this.before.length = 0;
    this.name = known.name;
    this.set(known.text);
  }

  private async again(): Promise<void> {
    if (!this.known || this.text.value === this.known.text) return;
    this.before.push(this.known.text);
    if (!(await this.run(this.text.value))) this.before.pop();
  }
  private async goBack(): Promise<void> {
    const text = this.before.pop();
    if (text !== undefined && !(await this.run(text))) this.before.push(text);
  }

  private set(text: string): void {
    this.text.value = text;
    this.back.disabled = this.before.length === 0;
    this.build();
  }
  // The form follows the text, and the text the form.
  private change(text: string): void {
    this.text.value = text;
    this.build();
  }

  private build(): void {
    const { known } = this;
    if (!known) return;
    const text = this.text.value;
    const entries = entriesOf(text);
    const fields: HTMLElement[] = [];
    const put = (entry: Entry) => (raw: string) => this.change(withValue(text, entry.line, raw));
    const find = (table: string, key: string) => entries.find((e) => e.table === table && e.key === key);

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
    const box = find("stock", "box_mm");
    const corners = box && BOX.exec(box.raw);
    if (box && corners) fields.push(...this.corners(corners, put(box)));
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

  private corners(corners: RegExpExecArray, put: (raw: string) => void): HTMLElement[] {
    const ends = [corners[1]!, corners[2]!].map((end) => end.split(",").map((v) => v.trim()));
    return ["x", "y", "z"].map((axis, n) => {
      const change = (end: number) => (value: string) => {
        ends[end]![n] = value;
        put(`[[${ends[0]!.join(", ")}], [${ends[1]!.join(", ")}]]`);
      };
      const [low, high] = [lengthField(ends[0]![n]!, change(0)), lengthField(ends[1]![n]!, change(1))];
      low.ariaLabel = t("stock from {axis}", { axis });
      high.ariaLabel = t("stock to {axis}", { axis });
      const both = document.createElement("span");
      both.append(low, ` ${t("to")} `, high, ` ${lengthUnit()}`);
      const row = document.createElement("div");
      row.className = "corner";
      row.append(t("stock {axis}", { axis }), both);
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

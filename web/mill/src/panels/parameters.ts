// SPDX-License-Identifier: MIT
// Sliders for values that can change while milling. All viewers share these values.

import { element } from "@tribo/ui/dom";
import { precise } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import type { Command, ServerInfo, Setting, Settings } from "@tribo/protocol/messages";

interface Parameter {
  key: Setting;
  label: string;
  min: number;
  max: number;
  unit: string;
  // The slider is logarithmic.
  log?: boolean;
  box: "parameters" | "feel-parameters";
}

const PARAMETERS: Parameter[] = [
  { key: "feed_percent", label: word("Feed"), min: 10, max: 300, unit: "%", box: "parameters" },
  { key: "spindle_percent", label: word("Spindle"), min: 10, max: 300, unit: "%", box: "parameters" },
  { key: "helix_deg", label: word("Helix"), min: 0, max: 60, unit: "°", box: "parameters" },
  { key: "force_scale", label: word("Force scale"), min: 0.001, max: 1, unit: "", log: true, box: "feel-parameters" },
  { key: "jnd", label: word("Table error"), min: 0.1, max: 10, unit: "JND", log: true, box: "feel-parameters" },
];

export class Parameters {
  private readonly shown = new Map<Setting, (value: number) => void>();
  private readonly material = element<HTMLSelectElement>("material");

  private readonly cases = element<HTMLInputElement>("cases");

  constructor(private readonly send: (command: Command) => void) {
    this.material.addEventListener("change", () => this.send({ op: "material", value: this.material.value }));
    this.cases.addEventListener("change", () => this.send({ op: "cases", value: this.cases.checked }));
    for (const p of PARAMETERS) element(p.box).append(this.slider(p));
  }

  clear(): void {
    element("cut").hidden = true;
  }

  info(message: ServerInfo): void {
    this.material.replaceChildren(...(message.materials ?? []).map((name) => new Option(name, name)));
    element("material-label").hidden = this.material.options.length === 0;
  }

  show(settings: Settings): void {
    element("cut").hidden = false;
    for (const [key, show] of this.shown) show(settings[key]);
    if (![...this.material.options].some((o) => o.value === settings.material)) {
      this.material.prepend(new Option(settings.material || t("the job's own"), settings.material));
    }
    this.material.value = settings.material;
    element("cases-label").hidden = !settings.has_spread;
    this.cases.checked = (settings.cases ?? 0) > 0;
    element("case-count").textContent = settings.cases ? t("{count} cases", { count: settings.cases }) : t("cases");
  }

  private slider(p: Parameter): HTMLElement {
    const label = document.createElement("label");
    label.className = "parameter";
    const name = document.createElement("span");
    name.textContent = t(p.label);
    const value = document.createElement("output");
    const input = document.createElement("input");
    const to = (v: number) => (p.log ? Math.log(v) : v);
    const from = (v: number) => (p.log ? Math.exp(v) : v);
    input.type = "range";
    input.min = String(to(p.min));
    input.max = String(to(p.max));
    input.step = "any";
    input.id = `set-${p.key}`;
    const say = (v: number) => {
      value.textContent = `${precise(v, 3)} ${p.unit}`;
      input.setAttribute("aria-valuetext", value.textContent);
    };
    input.addEventListener("input", () => say(from(Number(input.value))));
    input.addEventListener("change", () =>
      this.send({ op: "set", key: p.key, value: Number(from(Number(input.value)).toPrecision(4)) }),
    );
    this.shown.set(p.key, (v) => {
      if (document.activeElement !== input) input.value = String(to(v));
      say(v);
    });
    label.append(name, value, input);
    return label;
  }
}

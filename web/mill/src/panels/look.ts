// SPDX-License-Identifier: MIT
// How the page looks: theme, units and language, colours of the part, fine or plain, and what is drawn beside the part.

import { element } from "@tribo/ui/dom";
import { recall, remember } from "../page.js";
import { PALETTES } from "../sight/palette.js";
import type { PassShown } from "../sight/pass.js";
import { chooseUnit, type LengthUnit } from "../texts/figures.js";
import { language } from "../texts/texts.js";
import type { Look, Scene } from "../sight/scene.js";

// A choice kept between visits.
function kept(id: string, apply: (value: string) => void): void {
  const choice = element<HTMLSelectElement>(id);
  const before = recall(id);
  if ([...choice.options].some(({ value }) => value === before)) choice.value = before;
  const go = () => {
    remember(id, choice.value);
    apply(choice.value);
  };
  choice.addEventListener("change", go);
  go();
}

/** `speak` is called when another language is chosen. */
export function listenToLook(scene: Scene, speak: (to: string) => void): void {
  const root = document.documentElement;
  kept("theme", (theme) => {
    if (theme) root.dataset.theme = theme;
    else delete root.dataset.theme;
  });
  kept("palette", (name) => scene.setPalette(PALETTES[name as keyof typeof PALETTES]));
  kept("look", (look) => scene.setLook(look as Look));
  kept("passes", (shown) => scene.setPass(shown as PassShown));
  for (const what of ["tool", "positions", "arrow", "designed"] as const) {
    const box = element<HTMLInputElement>(`show-${what}`);
    box.addEventListener("change", () => scene.setVisible(what, box.checked));
  }
  kept("units", (unit) => chooseUnit(unit as LengthUnit));
  const spoken = element<HTMLSelectElement>("language");
  spoken.value = language;
  spoken.addEventListener("change", () => speak(spoken.value));
  element("language-note").hidden = language === "en";
  element("fit").addEventListener("click", () => scene.fit());
}

// SPDX-License-Identifier: MIT
// Two runs side by side: the first is kept as A, and compared with what is on the bench later.

import { element, wordsOf } from "@tribo/ui/dom";
import type { Moment } from "../keep/moment.js";
import { jobNameOf } from "../setup/with_job.js";
import { t } from "../texts/texts.js";
import type { ComparisonWindow } from "./window.js";

export interface Comparing {
  /** What is on the bench; undefined: the page has not got its files. */
  now: () => Moment | undefined;
  pause: () => void;
  say: (text: string) => void;
}

export function listenToCompare({ now, pause, say }: Comparing): void {
  let a: Moment | undefined;
  let shown: ComparisonWindow | undefined;
  element("keep-a").addEventListener("click", () => {
    a = now();
    if (!a) return;
    element("compare-runs").hidden = false;
    element("compare-said").textContent = t("A is {name}. Change the job or open another one, then compare.", {
      name: jobNameOf(a.order),
    });
  });
  element("compare-runs").addEventListener("click", async () => {
    const b = now();
    if (!a || !b) return;
    pause();
    try {
      const loaded = await import("./window.js");
      shown ??= new loaded.ComparisonWindow();
      shown.open(a, b);
    } catch (error) {
      say(t("The runs cannot be compared here: {why}.", { why: wordsOf(error) }));
    }
  });
}

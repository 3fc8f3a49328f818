// SPDX-License-Identifier: MIT
// Buttons that open a part of the page: panels, the sheet of the program, and the quiz and the gallery, which load when they are opened.

import { element, wordsOf } from "@tribo/ui/dom";
import type { Gallery } from "../gallery/gallery.js";
import type { Learn } from "../learn/learn.js";
import type { Order } from "../sources/workshop.js";
import { t } from "../texts/texts.js";

export interface OpenerActions {
  mill: (wanted: Order) => Promise<boolean>;
  say: (text: string) => void;
}

/** `opened` is called each time that the panel opens. */
export function toggles(button: string, panel: string, opened?: () => void): void {
  element(button).addEventListener("click", () => {
    const box = element(panel);
    box.hidden = !box.hidden;
    element(button).setAttribute("aria-expanded", String(!box.hidden));
    if (!box.hidden) opened?.();
  });
}

/** On a phone the program is a sheet. */
export function listenToProgramSheet(): void {
  element("show-program").addEventListener("click", () => {
    const reads = document.body.classList.toggle("reading");
    element("show-program").setAttribute("aria-expanded", String(reads));
  });
}

export function listenToMoreLanes(showAll: (all: boolean) => void): void {
  element("more-lanes").addEventListener("click", () => {
    const all = element("more-lanes").getAttribute("aria-pressed") !== "true";
    element("more-lanes").setAttribute("aria-pressed", String(all));
    showAll(all);
  });
}

/** Learn by ear. */
export function listenToQuiz({ mill, pause, say }: OpenerActions & { pause: () => void }): void {
  let learn: Learn | undefined;
  async function open(): Promise<void> {
    pause();
    try {
      const { Learn } = await import("../learn/learn.js");
      learn ??= new Learn((cut) => void mill(cut));
      learn.open();
    } catch (error) {
      say(t("The quiz does not open: {why}", { why: wordsOf(error) }));
    }
  }
  for (const id of ["learn", "learn-begin"]) element(id).addEventListener("click", () => void open());
}

export function listenToGallery({ mill, say }: OpenerActions): void {
  let gallery: Gallery | undefined;
  async function open(): Promise<void> {
    try {
      const { Gallery } = await import("../gallery/gallery.js");
      gallery ??= new Gallery(mill, say);
      gallery.open();
    } catch (error) {
      say(t("The examples do not open: {why}", { why: wordsOf(error) }));
    }
  }
  for (const id of ["examples", "show-examples"]) element(id).addEventListener("click", () => void open());
}

// SPDX-License-Identifier: MIT
// Files that the user chooses, or drops into the page.

import { element } from "@tribo/ui/dom";
import { dropped } from "./drop.js";

export function listenToFiles(open: (files: { name: string; file: File }[]) => Promise<void>): void {
  const chooser = element<HTMLInputElement>("files");
  element("open").addEventListener("click", () => chooser.click());
  chooser.addEventListener("change", () => {
    void open([...(chooser.files ?? [])].map((file) => ({ name: file.name, file })));
    chooser.value = "";
  });
  let inside = 0;
  addEventListener("dragenter", () => (element("drop").hidden = ++inside <= 0));
  addEventListener("dragleave", () => (element("drop").hidden = --inside <= 0));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    inside = 0;
    element("drop").hidden = true;
    if (event.dataTransfer) void dropped(event.dataTransfer).then(open);
  });
}

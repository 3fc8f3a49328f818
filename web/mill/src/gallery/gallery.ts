// SPDX-License-Identifier: MIT
// All examples with their pictures, in a window. A picture is fetched when it comes into sight.

import "./gallery.css";
import { element } from "@tribo/ui/dom";
import { addressOf, order } from "../sources/examples.js";
import type { Order } from "../sources/workshop.js";
import { t, translate } from "../texts/texts.js";
import { EXAMPLES, HIGH, pictureOf, WIDE, type Example } from "./list.js";

const WINDOW = `
<header>
  <h2 id="gallery-title">Examples</h2>
  <button id="gallery-close" type="button" aria-label="Close the examples">✕</button>
</header>
<ul id="gallery-examples"></ul>`;

export class Gallery {
  private readonly window = document.createElement("dialog");

  /** `mill` opens an example on the bench; `say` tells why not. */
  constructor(mill: (wanted: Order) => Promise<unknown>, say: (text: string) => void) {
    this.window.id = "gallery";
    this.window.setAttribute("aria-labelledby", "gallery-title");
    this.window.innerHTML = WINDOW;
    translate(this.window);
    document.body.append(this.window);
    element("gallery-close").addEventListener("click", () => this.window.close());
    const open = (example: Example) => {
      this.window.close();
      order(example).then(mill, (error: unknown) => say(String(error)));
    };
    element("gallery-examples").append(...EXAMPLES.map((example) => cardOf(example, () => open(example))));
  }

  open(): void {
    this.window.showModal();
  }
}

function cardOf(example: Example, open: () => void): HTMLElement {
  const picture = new Image(WIDE, HIGH);
  picture.loading = "lazy";
  picture.alt = "";
  picture.src = addressOf(pictureOf(example));
  const name = document.createElement("b");
  name.textContent = t(example.name);
  const about = document.createElement("span");
  about.textContent = t(example.about);
  const button = document.createElement("button");
  button.type = "button";
  button.dataset.job = example.job;
  button.append(picture, name, about);
  button.addEventListener("click", open);
  const item = document.createElement("li");
  item.append(button);
  return item;
}

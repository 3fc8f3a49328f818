// SPDX-License-Identifier: MIT
// What the page says to its user.

import { element } from "@tribo/ui/dom";

// Until it is dismissed, or until there is something else to say.
export function say(text: string): void {
  element("notice-box").hidden = text === "";
  element("notice").textContent = text;
}

// What can be done now, over the picture.
export function advise(text: string): void {
  element("hint").hidden = text === "";
  element("hint").textContent = text;
}

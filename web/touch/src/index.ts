// SPDX-License-Identifier: MIT
// Importing this file registers <tribo-touch>. Without a page (on a server) it does nothing.
import { TriboTouch } from "./element.js";

export { TriboTouch };
export type { ContactDetail, TriboErrorDetail } from "./element.js";

if (typeof customElements !== "undefined" && customElements.get("tribo-touch") === undefined) {
  customElements.define("tribo-touch", TriboTouch);
}

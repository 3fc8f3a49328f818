// SPDX-License-Identifier: MIT
// What the script of the part's view takes from the page's script instead of having it twice.
export { vec3 } from "@tribo/protocol/vec3";
export { fitToScreen } from "@tribo/ui/canvas";
export { element } from "@tribo/ui/dom";
export { data, rows } from "./data.js";
export { clamp, short } from "./numbers.js";
export { follow, selected } from "./selection.js";

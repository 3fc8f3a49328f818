// SPDX-License-Identifier: MIT
// Functions of the page script that the script of the part view uses, so that they exist only once.
export { vec3 } from "@tribo/protocol/vec3";
export { fitToScreen } from "@tribo/ui/canvas";
export { element } from "@tribo/ui/dom";
export { data, rows } from "./data.js";
export { clamp, short } from "./numbers.js";
export { follow, selected } from "./selection.js";

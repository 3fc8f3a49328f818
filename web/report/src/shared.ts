// SPDX-License-Identifier: MIT
// Functions that the scripts of the pages share, so that they exist only once in a page.
export { vec3 } from "@tribo/protocol/vec3";
export { fitToScreen } from "@tribo/ui/canvas";
export { element } from "@tribo/ui/dom";
export { clamp, short } from "./numbers.js";

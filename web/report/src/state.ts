// SPDX-License-Identifier: MIT
// What the page script knows and the script of the part view uses: the data, and the selected row.
export { data, rows } from "./data.js";
export { follow, selected } from "./selection.js";

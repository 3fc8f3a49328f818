// SPDX-License-Identifier: MIT
// What picture.test.ts draws with.
export * from "../src/engine.js";
export * from "../src/relief.js";
export * from "../src/renderer.js";

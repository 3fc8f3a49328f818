// SPDX-License-Identifier: MIT
// The types of exports.ts against the modules: the same names with as many parameters.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { load } from "./load.js";

const text = readFileSync(join(import.meta.dirname, "../src/exports.ts"), "utf8");

interface Declared {
  base: string | undefined;
  functions: string[];
}

/** The interfaces of the file: whom they extend, and each function as name/parameters. */
const declared = new Map<string, Declared>();
for (const [, name = "", base, body = ""] of text.matchAll(
  /export interface (\w+)(?: extends (\w+))? \{\n([^]*?)\n\}/g,
)) {
  const functions = [...body.matchAll(/^ {2}(\w+)\(([^)]*)\)/gm)].map(
    ([, called, parameters = ""]) => `${called}/${parameters.split(",").filter((p) => p.trim() !== "").length}`,
  );
  declared.set(name, { base, functions });
}

function functionsOf(name: string): string[] {
  const { base, functions } = declared.get(name)!;
  return base === undefined ? functions : [...functionsOf(base), ...functions];
}

test.each([
  ["tribo", "MillExports"],
  ["mill_sound", "MillSoundExports"],
  ["touch", "TouchExports"],
  ["learn", "LearnExports"],
  ["golden", "GoldenExports"],
])("%s.wasm exports what %s says", async (module, name) => {
  const exports = Object.entries(await load(module));
  const functions = exports.flatMap(([called, value]) =>
    typeof value === "function" ? [`${called}/${value.length}`] : [],
  );
  expect(functionsOf(name).sort()).toEqual(functions.sort());
});

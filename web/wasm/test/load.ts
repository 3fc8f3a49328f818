// SPDX-License-Identifier: MIT
// The built modules in Node.js.
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { expect } from "vitest";
import { MODULES } from "../../tools/places.js";
import type { AnyExports } from "../src/exports.js";
import { instantiate } from "../src/module.js";

export async function load<Exports extends AnyExports>(name: string): Promise<Exports> {
  const module = await WebAssembly.compile(await readFile(join(MODULES, `${name}.wasm`)));
  expect(WebAssembly.Module.imports(module), `what ${name}.wasm imports`).toEqual([]);
  return instantiate<Exports>(module);
}

// SPDX-License-Identifier: MIT
// From the address of a module to its exports. The modules import nothing.

import type { AnyExports } from "./exports.js";

/** A compiled module that knows what it exports; workers and worklets may be sent it. */
export interface Compiled<Exports extends AnyExports> extends WebAssembly.Module {
  /** A type without a value. */
  readonly exports?: Exports;
}

/** `name` lies beside `base`. */
export async function compile<Exports extends AnyExports>(name: string, base: string): Promise<Compiled<Exports>> {
  const response = await fetch(new URL(name, base));
  if (!response.ok) throw new Error(`${name}: HTTP ${response.status}`);
  // To compile on the way asks for a type that not every server knows.
  return WebAssembly.compileStreaming(new Response(response.body, { headers: { "Content-Type": "application/wasm" } }));
}

function ready<Exports extends AnyExports>(instance: WebAssembly.Instance): Exports {
  const exports = instance.exports as unknown as Exports;
  exports._initialize();
  return exports;
}

/** A new instance with a memory of its own. */
export async function instantiate<Exports extends AnyExports>(module: Compiled<Exports>): Promise<Exports> {
  return ready(await WebAssembly.instantiate(module));
}

/** The same at once, where waiting is not possible: an audio worklet's constructor. */
export function instantiateNow<Exports extends AnyExports>(module: Compiled<Exports>): Exports {
  return ready(new WebAssembly.Instance(module));
}

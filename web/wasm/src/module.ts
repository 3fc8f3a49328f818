// SPDX-License-Identifier: MIT
// Loads a module from its address and returns its exports. The modules import nothing.

import type { AnyExports } from "./exports.js";

/** A compiled module with the type of its exports. It can be sent to workers and worklets. */
export interface Compiled<Exports extends AnyExports> extends WebAssembly.Module {
  /** A type without a value. */
  readonly exports?: Exports;
}

/** `name` is in the folder of `base`. */
export async function compile<Exports extends AnyExports>(name: string, base: string): Promise<Compiled<Exports>> {
  const response = await fetch(new URL(name, base));
  if (!response.ok) throw new Error(`${name}: HTTP ${response.status}`);
  // Streaming compilation needs a media type that not every server sends.
  return WebAssembly.compileStreaming(new Response(response.body, { headers: { "Content-Type": "application/wasm" } }));
}

function ready<Exports extends AnyExports>(instance: WebAssembly.Instance): Exports {
  const exports = instance.exports as unknown as Exports;
  exports._initialize();
  return exports;
}

/** Returns a new instance with its own memory. */
export async function instantiate<Exports extends AnyExports>(module: Compiled<Exports>): Promise<Exports> {
  return ready(await WebAssembly.instantiate(module));
}

/** The same without waiting, for the constructor of an audio worklet. */
export function instantiateNow<Exports extends AnyExports>(module: Compiled<Exports>): Exports {
  return ready(new WebAssembly.Instance(module));
}

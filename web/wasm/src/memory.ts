// SPDX-License-Identifier: MIT
// Copies data into and out of the memory of a module. A growing memory detaches all its views. Therefore no view is
// kept here, and callers must not keep one across a call of the module.

import type { Address, AnyExports, CommonExports } from "./exports.js";

export const bytesAt = (x: AnyExports, at: Address, length: number) => new Uint8Array(x.memory.buffer, at, length);
export const floatsAt = (x: AnyExports, at: Address, length: number) => new Float32Array(x.memory.buffer, at, length);
export const doublesAt = (x: AnyExports, at: Address, length: number) => new Float64Array(x.memory.buffer, at, length);

/** Reads UTF-8 up to a zero. */
export function textAt(x: AnyExports, at: Address): string {
  const bytes = new Uint8Array(x.memory.buffer, at);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

/** Copies data to the module and passes its address to `use`. */
export function lend<Result>(
  x: CommonExports,
  data: ArrayBufferView,
  use: (at: Address, length: number) => Result,
): Result {
  const length = data.byteLength;
  const at = x.tribo_allocate(length);
  bytesAt(x, at, length).set(new Uint8Array(data.buffer, data.byteOffset, length));
  const result = use(at, length);
  x.tribo_release(at);
  return result;
}

export function lendText<Result>(x: CommonExports, text: string, use: (at: Address, length: number) => Result): Result {
  return lend(x, new TextEncoder().encode(text), use);
}

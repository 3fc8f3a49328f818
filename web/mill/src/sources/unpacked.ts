// SPDX-License-Identifier: MIT
// A file as it was before gzip.

import type { JobFile } from "./workshop.js";

export async function unpacked(file: JobFile): Promise<Uint8Array> {
  const bytes = new Uint8Array(file.bytes);
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const stream = new Blob([file.bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

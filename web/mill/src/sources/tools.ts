// SPDX-License-Identifier: MIT
// Tool libraries among the files of a drop.

import type { JobFile } from "./workshop.js";

const TABLES = /\.(tbl|fctb|tools|json|xml)$/i;

/** As readers/tables/tool_table.hpp tells them: a CSV file by its columns. */
export function isToolLibrary({ name, bytes }: JobFile): boolean {
  if (TABLES.test(name)) return true;
  if (!/\.csv$/i.test(name)) return false;
  const [header = ""] = new TextDecoder().decode(bytes.slice(0, 4096)).split(/[\r\n]/, 1);
  return /tool_diameter|diameter_mm/.test(header);
}

// Places in a zip archive (APPNOTE 6.3): of its directory, and of one file in it.
const END = { sign: 0x06054b50, length: 22, count: 10, directory: 16 };
const ENTRY = { sign: 0x02014b50, length: 46, method: 10, packed: 20, name: 28, extra: 30, comment: 32, local: 42 };
const LOCAL = { length: 30, name: 26, extra: 28 };

/** The JSON file in an archive of Fusion (.tools); other files as they are. */
export async function unpacked(file: JobFile): Promise<JobFile> {
  const view = new DataView(file.bytes);
  if (!/\.tools$/i.test(file.name) || view.byteLength < END.length || view.getUint32(0, false) !== 0x504b0304)
    return file;
  let end = view.byteLength - END.length;
  while (end > 0 && view.getUint32(end, true) !== END.sign) --end;
  let at = view.getUint32(end + END.directory, true);
  for (let left = view.getUint16(end + END.count, true); left > 0; --left) {
    if (at + ENTRY.length > view.byteLength || view.getUint32(at, true) !== ENTRY.sign) return file;
    const length = view.getUint16(at + ENTRY.name, true);
    const name = new TextDecoder().decode(new Uint8Array(file.bytes, at + ENTRY.length, length));
    if (name.endsWith(".json")) {
      const local = view.getUint32(at + ENTRY.local, true);
      const start =
        local + LOCAL.length + view.getUint16(local + LOCAL.name, true) + view.getUint16(local + LOCAL.extra, true);
      const packed = new Blob([file.bytes.slice(start, start + view.getUint32(at + ENTRY.packed, true))]);
      const isStored = view.getUint16(at + ENTRY.method, true) === 0;
      const stream = isStored ? packed.stream() : packed.stream().pipeThrough(new DecompressionStream("deflate-raw"));
      return { name: file.name, bytes: await new Response(stream).arrayBuffer() };
    }
    at += ENTRY.length + length + view.getUint16(at + ENTRY.extra, true) + view.getUint16(at + ENTRY.comment, true);
  }
  return file;
}

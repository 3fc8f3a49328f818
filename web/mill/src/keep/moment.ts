// SPDX-License-Identifier: MIT
// A moment of a cut, to be opened again elsewhere: the job with its files, its settings, the time and the view. In a
// link it is the fragment of the address, which browsers do not send to the server; a larger one is a file.
//
// Bytes, compressed by deflate: u32 length of a JSON text, little-endian; the text; the files one after the other.

import type { Setting, Settings } from "@tribo/protocol/messages";
import type { Vec3 } from "@tribo/protocol/vec3";
import { t, word } from "../texts/texts.js";
import type { JobFile, Order } from "../sources/workshop.js";

/** Where the camera is, mm. */
export interface View {
  position: Vec3;
  target: Vec3;
}

/** A setting that is not as the job says. */
export type Change = { key: Setting; value: number } | { key: "material"; value: string };

export interface Moment {
  order: Order;
  t_s: number;
  changes: Change[];
  view: View;
  colouring: string;
}

const CUT = ["feed_percent", "spindle_percent", "helix_deg"] as const;
/** What changes the cut. */
export function changesOf(written: Settings, now: Settings): Change[] {
  const changes: Change[] = CUT.filter((key) => now[key] !== written[key]).map((key) => ({ key, value: now[key] }));
  return now.material === written.material ? changes : [...changes, { key: "material", value: now.material }];
}

/** Largest number of characters after the "#": programs that pass links on cut off longer ones. */
export const LONGEST_FRAGMENT = 16_000;
export const ENDING = ".moment";
const FRAGMENT = "#moment=";
const VERSION = 1;
// A file may say that it unpacks to more than a page can hold.
const LARGEST = 256 << 20;

class TooLarge extends Error {}

interface Written extends Omit<Moment, "order"> {
  version: number;
  job: string;
  part: string;
  cell: number;
  // `beside`: the file lies beside the page and is not among the bytes.
  files: { name: string; bytes: number; beside?: true }[];
}

async function through(bytes: BlobPart, transform: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const reader = new Blob([bytes]).stream().pipeThrough(transform).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(parts).arrayBuffer());
    parts.push(value);
    length += value.length;
    if (length > LARGEST) {
      await reader.cancel();
      throw new TooLarge(t("it is too large for a page"));
    }
  }
}

/** `whole`: with the files that lie beside the page. */
export async function pack({ order, ...rest }: Moment, whole: boolean): Promise<Uint8Array> {
  const carried = (file: JobFile) => whole || !file.beside;
  const written: Written = {
    version: VERSION,
    job: order.job,
    part: order.part,
    cell: order.cell,
    files: order.files.map((file) =>
      carried(file) ? { name: file.name, bytes: file.bytes.byteLength } : { name: file.name, bytes: 0, beside: true },
    ),
    ...rest,
  };
  const text = new TextEncoder().encode(JSON.stringify(written));
  const length = new DataView(new ArrayBuffer(4));
  length.setUint32(0, text.length, true);
  const files = order.files.filter(carried).map(({ bytes }) => bytes);
  const all = await new Blob([length.buffer, text, ...files]).arrayBuffer();
  return through(all, new CompressionStream("deflate-raw"));
}

const isText = (value: unknown) => typeof value === "string";
const isPlace = (value: unknown): value is Vec3 =>
  Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);

function isWritten({ job, part, cell, files, t_s, changes, view, colouring }: Written): boolean {
  return (
    [job, part, colouring].every(isText) &&
    [cell, t_s].every(Number.isFinite) &&
    [view.position, view.target].every(isPlace) &&
    changes.every(({ key, value }) => isText(key) && (key === "material" ? isText(value) : Number.isFinite(value))) &&
    files.every(({ name, bytes }) => isText(name) && Number.isInteger(bytes) && bytes >= 0)
  );
}

const DAMAGED = word("it is damaged, perhaps its end was cut off on the way");

async function read(packed: BlobPart): Promise<{ written: Written; rest: Uint8Array }> {
  const all = await through(packed, new DecompressionStream("deflate-raw")).catch((error: unknown) => {
    throw error instanceof TooLarge ? error : new Error(t(DAMAGED));
  });
  try {
    const length = new DataView(all.buffer).getUint32(0, true);
    const written = JSON.parse(new TextDecoder().decode(all.subarray(4, 4 + length))) as Written;
    if (written.version === VERSION && isWritten(written)) return { written, rest: all.subarray(4 + length) };
  } catch {
    throw new Error(t(DAMAGED));
  }
  throw new Error(t("it is of another version of this page"));
}

/** Throws if the bytes are not a moment. `beside` gives a file that lies beside the page. */
export async function unpack(packed: BlobPart, beside: (name: string) => Promise<JobFile>): Promise<Moment> {
  const { written, rest } = await read(packed);
  const files: JobFile[] = [];
  let at = 0;
  for (const { name, bytes, beside: isBeside } of written.files) {
    files.push(isBeside ? await beside(name) : { name, bytes: rest.slice(at, at + bytes).buffer });
    at += bytes;
  }
  if (at > rest.length) throw new Error(t(DAMAGED));
  const { job, part, cell, t_s, changes, view, colouring } = written;
  return { order: { files, job, part, cell }, t_s, changes, view, colouring };
}

/** The part of an address that holds a moment; undefined: it would be too long. */
export function fragmentOf(packed: Uint8Array): string | undefined {
  if ((4 * packed.length) / 3 > LONGEST_FRAGMENT) return undefined;
  // Without the characters that have a meaning in an address (RFC 4648, section 5).
  const text = btoa(String.fromCharCode(...packed));
  return FRAGMENT + text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The bytes in the fragment of an address; undefined: it holds no moment. */
export function packedIn(fragment: string): Uint8Array<ArrayBuffer> | undefined {
  if (!fragment.startsWith(FRAGMENT)) return undefined;
  const text = fragment.slice(FRAGMENT.length).replaceAll("-", "+").replaceAll("_", "/");
  try {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  } catch {
    // unpack() says that nothing is not a moment.
    return new Uint8Array();
  }
}

// SPDX-License-Identifier: MIT
// The length of a recorded WebM file. Browsers do not know it while they write the head of the file, and players then
// show no time line. (Matroska and EBML: RFC 9559 and RFC 8794.)

const EBML = 0x1a45dfa3;
const SEGMENT = 0x18538067;
const INFO = 0x1549a966;
const DURATION = 0x4489;

interface Element {
  id: number;
  begin: number; // of its content
  size: number; // of its content; Infinity: not known
}

// A number of 1 to 8 bytes; the zeros at its head say how many follow. `marked`: with the bit that ends these zeros, as
// in an id.
function numberAt(bytes: Uint8Array, at: number, marked: boolean): { value: number; length: number } | undefined {
  const head = bytes[at];
  if (!head) return undefined;
  const length = Math.clz32(head) - 23;
  let value = marked ? head : head & ((1 << (8 - length)) - 1);
  let unknown = value === (1 << (8 - length)) - 1;
  for (let n = 1; n < length; ++n) {
    const byte = bytes[at + n] ?? 0;
    unknown &&= byte === 255;
    value = 256 * value + byte;
  }
  return { value: unknown && !marked ? Infinity : value, length };
}

function elementAt(bytes: Uint8Array, at: number): Element | undefined {
  const id = numberAt(bytes, at, true);
  const size = id && numberAt(bytes, at + id.length, false);
  return size && { id: id.value, begin: at + id.length + size.length, size: size.value };
}

/** `head` is the beginning of a file. Returns it with the length, ms, or as it is if that is there or has no place. */
export function withLength(head: Uint8Array<ArrayBuffer>, ms: number): Uint8Array<ArrayBuffer> {
  let at = 0;
  for (let element = elementAt(head, at); element; element = elementAt(head, at)) {
    if (element.id === INFO) return withLengthIn(head, at, element, ms);
    if (element.id === SEGMENT) at = element.begin;
    else if (element.id === EBML || at > 0) at = element.begin + element.size;
    else break;
  }
  return head;
}

function withLengthIn(head: Uint8Array<ArrayBuffer>, at: number, info: Element, ms: number): Uint8Array<ArrayBuffer> {
  const end = info.begin + info.size;
  for (let inner = info.begin; inner < end;) {
    const element = elementAt(head, inner);
    if (!element || element.id === DURATION) return head;
    inner = element.begin + element.size;
  }
  // The unit is the time scale of the file: browsers write 1 ms.
  const duration = new DataView(new ArrayBuffer(11));
  duration.setUint16(0, DURATION);
  duration.setUint8(2, 0x88);
  duration.setFloat64(3, ms);
  // The size of the longer element, in eight bytes.
  const size = new DataView(new ArrayBuffer(8));
  size.setUint32(0, 0x01000000);
  size.setUint32(4, info.size + duration.byteLength);
  const parts = [head.subarray(0, at + 4), size, head.subarray(info.begin, end), duration, head.subarray(end)];
  const out = new Uint8Array(parts.reduce((sum, part) => sum + part.byteLength, 0));
  let to = 0;
  for (const { buffer, byteOffset, byteLength } of parts) {
    out.set(new Uint8Array(buffer, byteOffset, byteLength), to);
    to += byteLength;
  }
  return out;
}

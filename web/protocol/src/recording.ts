// SPDX-License-Identifier: MIT
// Recorded frames in a file: "TRIBOREC", u32 1 (the version), u32 0; then for each frame u32 length, u32 0, f64
// seconds since the first frame, its bytes, zeros to a multiple of 8. Little-endian.

const MAGIC = "TRIBOREC";
const VERSION = 1;
const HEADER = 16;

export class Recorder {
  private readonly parts: BlobPart[] = [];
  private readonly began = performance.now();
  frames = 0;

  constructor() {
    const header = new DataView(new ArrayBuffer(HEADER));
    for (let n = 0; n < MAGIC.length; ++n) header.setUint8(n, MAGIC.charCodeAt(n));
    header.setUint32(8, VERSION, true);
    this.parts.push(header.buffer);
  }

  take(bytes: ArrayBuffer): void {
    const head = new DataView(new ArrayBuffer(16));
    head.setUint32(0, bytes.byteLength, true);
    head.setFloat64(8, (performance.now() - this.began) / 1000, true);
    this.parts.push(head.buffer, bytes, new Uint8Array((8 - (bytes.byteLength % 8)) % 8));
    ++this.frames;
  }

  file(): Blob {
    return new Blob(this.parts, { type: "application/octet-stream" });
  }
}

export interface Recorded {
  seconds: number;
  bytes: ArrayBuffer;
}

function isRecording(bytes: ArrayBuffer): boolean {
  return new TextDecoder("latin1").decode(bytes.slice(0, MAGIC.length)) === MAGIC;
}

// Throws an Error with a text if the bytes are not a recording or are truncated.
export function readRecording(bytes: ArrayBuffer): Recorded[] {
  if (bytes.byteLength < HEADER || !isRecording(bytes)) throw new Error("this is no recording of Tribo's");
  const view = new DataView(bytes);
  if (view.getUint32(8, true) !== VERSION)
    throw new Error(`recordings of version ${view.getUint32(8, true)} are not known`);
  const all: Recorded[] = [];
  for (let at = HEADER; at < bytes.byteLength;) {
    if (at + 16 > bytes.byteLength) throw new Error("the recording is cut off");
    const length = view.getUint32(at, true);
    const seconds = view.getFloat64(at + 8, true);
    if (at + 16 + length > bytes.byteLength) throw new Error("the recording is cut off");
    all.push({ seconds, bytes: bytes.slice(at + 16, at + 16 + length) });
    at += 16 + 8 * Math.ceil(length / 8);
  }
  if (all.length === 0) throw new Error("the recording is empty");
  return all;
}

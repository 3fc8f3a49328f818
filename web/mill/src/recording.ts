// SPDX-License-Identifier: MIT
// Frames kept in a file, and a file played again as if an engine sent it. The file: "TRIBOREC" and a version,
// u32 1, four zeros; then of each frame u32 length, four zeros, f64 seconds since the first, its bytes,
// zeros to a multiple of 8. Little-endian.

import { decodeFrame, type StateFrame } from "./frames.js";
import type { Command, Listener, Source } from "./source.js";

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

export function isRecording(bytes: ArrayBuffer): boolean {
  return new TextDecoder("latin1").decode(bytes.slice(0, MAGIC.length)) === MAGIC;
}

// Throws an Error in words on what is no recording or was cut off.
export function readRecording(bytes: ArrayBuffer): Recorded[] {
  if (bytes.byteLength < HEADER || !isRecording(bytes)) throw new Error("this is no recording of Tribo's");
  const view = new DataView(bytes);
  if (view.getUint32(8, true) !== VERSION) throw new Error(`recordings of version ${view.getUint32(8, true)} are not known`);
  const all: Recorded[] = [];
  for (let at = HEADER; at < bytes.byteLength; ) {
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

// Plays a recording: play, pause, speed and seek work on the time in which it was made.
export class Replay implements Source {
  private next = 0;
  private clock = 0;
  private speed = 1;
  private playing = true;
  private before = performance.now();
  private last: { state: StateFrame; bytes: ArrayBuffer } | undefined;
  private readonly timer = setInterval(() => this.tick(), 1000 / 60);

  constructor(
    private readonly listener: Listener,
    private readonly frames: Recorded[],
    name: string,
  ) {
    listener.line(true, "");
    listener.info({ op: "serverInfo", version: "", job: name, warnings: [] });
  }

  send(command: Command): void {
    if (command.op === "play" || command.op === "pause") {
      this.playing = command.op === "play";
      if (this.playing && this.next >= this.frames.length) this.next = this.clock = 0;
      this.tellState();
    } else if (command.op === "speed") {
      this.speed = command.value;
    } else if (command.op === "seek") {
      // To the state whose program time is the one asked for; all before it counts.
      const at = this.frames.findIndex(({ bytes }) => {
        const view = new DataView(bytes);
        return view.getUint8(0) === 3 && view.getFloat64(8, true) >= command.t_s;
      });
      this.next = 0;
      this.show(at < 0 ? this.frames.length : at + 1);
    }
  }

  close(): void {
    clearInterval(this.timer);
  }

  private tick(): void {
    const now = performance.now();
    if (this.playing) this.clock += (this.speed * Math.min(now - this.before, 100)) / 1000;
    this.before = now;
    let until = this.next;
    while (until < this.frames.length && this.frames[until]!.seconds <= this.clock) ++until;
    if (this.playing && until > this.next) this.show(until);
  }

  private show(until: number): void {
    for (; this.next < until; ++this.next) {
      const { bytes } = this.frames[this.next]!;
      const frame = decodeFrame(bytes);
      if (frame.kind === "state") {
        this.last = { state: frame, bytes };
        this.tellState();
      } else {
        this.listener.frame(frame, bytes);
      }
    }
    this.clock = this.frames[Math.max(this.next - 1, 0)]!.seconds;
    if (this.next < this.frames.length || !this.playing) return;
    this.playing = false;
    this.tellState();
  }

  // Whether it plays, and how fast, is for this page to say and not for the one that recorded it.
  private tellState(): void {
    if (!this.last) return;
    const { state, bytes } = this.last;
    this.listener.frame({ ...state, playing: this.playing, speed: this.speed }, bytes);
  }
}

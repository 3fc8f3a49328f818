// SPDX-License-Identifier: MIT
// Plays a recording as if an engine sent it.

import { decodeFrame, type StateFrame } from "@tribo/protocol/frames";
import type { Command } from "@tribo/protocol/messages";
import type { Recorded } from "@tribo/protocol/recording";
import type { Listener, Source } from "./source.js";

// Play, pause, speed and seek refer to the time of the recording.
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
      // Go to the first state with at least this program time, with all frames before it.
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

  // This page sets play state and speed; those of the recording are ignored.
  private tellState(): void {
    if (!this.last) return;
    const { state, bytes } = this.last;
    this.listener.frame({ ...state, playing: this.playing, speed: this.speed }, bytes);
  }
}

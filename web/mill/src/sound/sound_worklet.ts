// SPDX-License-Identifier: MIT
// The part of sound.ts on the audio thread.

import type { MillSoundExports } from "@tribo/wasm/exports";
import { bytesAt, floatsAt } from "@tribo/wasm/memory";
import { instantiateNow, type Compiled } from "@tribo/wasm/module";
import type { ToEar } from "./sound.js";

const LARGEST_FRAME = 1 << 18;

class Ear extends AudioWorkletProcessor {
  private readonly x: MillSoundExports;
  private readonly inbox: number;
  private readonly open: boolean;

  constructor(options: { processorOptions: { module: Compiled<MillSoundExports> } }) {
    super();
    this.x = instantiateNow(options.processorOptions.module);
    this.inbox = this.x.tribo_allocate(LARGEST_FRAME);
    this.open = this.x.sound_open(sampleRate) !== 0;
    this.port.onmessage = ({ data }: MessageEvent<ToEar>) => this.take(data);
  }

  private take(message: ToEar): void {
    if (message.kind === "clock") {
      this.x.sound_follow(message.time, message.speed, Number(message.playing), message.lead);
    } else if (message.bytes.byteLength <= LARGEST_FRAME) {
      bytesAt(this.x, this.inbox, message.bytes.byteLength).set(new Uint8Array(message.bytes));
      this.x.sound_take(this.inbox, message.bytes.byteLength);
    }
  }

  process(_inputs: Float32Array[][], [output]: Float32Array[][]): boolean {
    const [left, right] = output ?? [];
    if (!this.open || !left || !right) return true;
    const samples = floatsAt(this.x, this.x.sound_render(left.length), 2 * left.length);
    for (let n = 0; n < left.length; ++n) {
      left[n] = samples[2 * n]!;
      right[n] = samples[2 * n + 1]!;
    }
    return true;
  }
}

registerProcessor("tribo-mill", Ear);

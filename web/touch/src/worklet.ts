// SPDX-License-Identifier: MIT
// The audio thread: a separate instance of touch.wasm, with a friction voice for each element that has sound.
import type { TouchExports } from "@tribo/wasm/exports";
import { bytesAt, floatsAt, lend } from "@tribo/wasm/memory";
import { instantiateNow, type Compiled } from "@tribo/wasm/module";
import type { VoiceMessage, VoiceRefusal } from "./audio.js";

interface Playing {
  voice: number;
  moving: boolean;
  /** Quanta to play after the last target was silence, for the decay. */
  tail: number;
  pan: number;
  panTarget: number;
  gain: number;
  gainTarget: number;
}

const kMostFrames = 1024;
const kTailQuanta = 40;
/** With a terminating zero. */
const kMostRefusalBytes = 128;

class Friction extends AudioWorkletProcessor {
  #x: TouchExports;
  #out: number;
  #voices = new Map<number, Playing>();

  constructor(options: { processorOptions: { module: Compiled<TouchExports> } }) {
    super();
    this.#x = instantiateNow(options.processorOptions.module);
    this.#out = this.#x.tribo_allocate(4 * kMostFrames);
    this.port.onmessage = (event: MessageEvent<VoiceMessage>) => this.#take(event.data);
  }

  #take(message: VoiceMessage): void {
    const playing = this.#voices.get(message.id);
    if (message.kind === "add") {
      if (playing !== undefined) this.#x.voice_destroy(playing.voice);
      const { numbers } = message;
      const voice = lend(this.#x, numbers, (at) =>
        this.#x.voice_create(at, numbers.length, sampleRate, message.id, Number(message.published)),
      );
      if (voice === 0) {
        // TextDecoder is not available here.
        const bytes = bytesAt(this.#x, this.#x.voice_refusal(), kMostRefusalBytes);
        const wrong = String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
        this.port.postMessage({ id: message.id, wrong } satisfies VoiceRefusal);
        return;
      }
      this.#voices.set(message.id, { voice, moving: false, tail: 0, pan: 0, panTarget: 0, gain: 1, gainTarget: 1 });
    } else if (playing !== undefined && message.kind === "target") {
      this.#x.voice_set_target(playing.voice, message.speed, message.force);
      playing.moving = message.speed > 0 && message.force > 0;
      if (playing.moving && playing.tail === 0) {
        playing.pan = message.pan;
        playing.gain = message.gain;
      }
      if (playing.moving) playing.tail = kTailQuanta;
      playing.panTarget = message.pan;
      playing.gainTarget = message.gain;
    } else if (playing !== undefined && message.kind === "remove") {
      this.#x.voice_destroy(playing.voice);
      this.#voices.delete(message.id);
    }
  }

  process(_inputs: Float32Array[][], outputs: Float32Array[][]): boolean {
    const left = outputs[0]?.[0];
    const right = outputs[0]?.[1] ?? left;
    if (left === undefined || right === undefined) return true;
    const frames = Math.min(left.length, kMostFrames);
    for (const p of this.#voices.values()) {
      // A silent voice is not rendered.
      if (p.tail === 0) continue;
      if (!p.moving) --p.tail;
      this.#x.voice_render(p.voice, this.#out, frames);
      const mono = floatsAt(this.#x, this.#out, frames);
      const panStep = (p.panTarget - p.pan) / frames;
      const gainStep = (p.gainTarget - p.gain) / frames;
      for (let i = 0; i < frames; ++i) {
        p.pan += panStep;
        p.gain += gainStep;
        // Constant power, 1 on both sides in the centre.
        const sample = mono[i]! * p.gain;
        const angle = ((p.pan + 1) * Math.PI) / 4;
        left[i] = left[i]! + sample * Math.SQRT2 * Math.cos(angle);
        right[i] = right[i]! + sample * Math.SQRT2 * Math.sin(angle);
      }
    }
    return true;
  }
}

registerProcessor("tribo-friction", Friction);

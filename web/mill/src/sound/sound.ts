// SPDX-License-Identifier: MIT
// The sound of the page: passes frames and the clock of the picture to mill_sound.wasm in an AudioWorklet. Begins
// with the first gesture, as browsers require.

import type { MillSoundExports } from "@tribo/wasm/exports";
import { openAudio } from "@tribo/ui/audio";
import { compile } from "@tribo/wasm/module";
import type { StateFrame } from "@tribo/protocol/frames";
import { KEPT_SOUNDS } from "../sources/frame_cache.js";
import workletUrl from "./sound_worklet.ts?worker&url";

export type ToEar =
  | { kind: "frame"; bytes: ArrayBuffer }
  | { kind: "clock"; time: number; speed: number; playing: boolean; lead: number };

export class Sound {
  private context: AudioContext | undefined;
  private node: AudioWorkletNode | undefined;
  private gain: GainNode | undefined;
  private opening: Promise<void> | undefined;
  // Frames that the worklet needs even if it starts late.
  private job: ArrayBuffer | undefined;
  private listening: ArrayBuffer | undefined;
  private bending: ArrayBuffer | undefined;
  private sounds: ArrayBuffer[] = [];
  private isMuted = false;
  analyser: AnalyserNode | undefined;

  // True if this page may play sound: AudioWorklet requires https or localhost.
  static get possible(): boolean {
    return typeof AudioContext !== "undefined" && "audioWorklet" in AudioContext.prototype && isSecureContext;
  }

  get running(): boolean {
    return this.context?.state === "running";
  }
  get muted(): boolean {
    return this.isMuted;
  }
  set muted(on: boolean) {
    this.isMuted = on;
    if (this.gain && this.context) this.gain.gain.setTargetAtTime(on ? 0 : 1, this.context.currentTime, 0.02);
  }

  // Must be called in a gesture.
  wake(): Promise<void> {
    if (!Sound.possible) return Promise.resolve();
    this.opening ??= this.open();
    return this.opening.then(() => this.context?.resume());
  }

  /** What is heard, to be recorded. None before wake(). The caller stops them. */
  tracks(): MediaStreamTrack[] {
    if (!this.context || !this.gain) return [];
    const to = new MediaStreamAudioDestinationNode(this.context);
    this.gain.connect(to);
    return to.stream.getAudioTracks();
  }

  frame(kind: string, bytes: ArrayBuffer): void {
    if (kind === "job") {
      this.job = bytes;
      this.bending = undefined;
      this.sounds = [];
    } else if (kind === "listening") {
      this.listening = bytes;
    } else if (kind === "bending") {
      this.bending = bytes;
    } else if (kind === "sound") {
      this.sounds.push(bytes);
      if (this.sounds.length > KEPT_SOUNDS) this.sounds.shift();
    } else {
      return;
    }
    // The path of the job is long and not needed for sound.
    this.post({ kind: "frame", bytes: kind === "job" ? bytes.slice(0, 16) : bytes });
  }

  state(state: StateFrame): void {
    const lead = this.context ? this.context.outputLatency || this.context.baseLatency || 0 : 0;
    this.post({ kind: "clock", time: state.time, speed: state.speed, playing: state.playing, lead });
  }

  private post(message: ToEar): void {
    this.node?.port.postMessage(message);
  }

  private async open(): Promise<void> {
    const module = compile<MillSoundExports>("mill_sound.wasm", document.baseURI);
    const { context, node } = await openAudio("tribo-mill", workletUrl, module);
    this.gain = new GainNode(context, { gain: this.isMuted ? 0 : 1 });
    this.analyser = new AnalyserNode(context, { fftSize: 4096, smoothingTimeConstant: 0 });
    node.connect(this.gain).connect(context.destination);
    node.connect(this.analyser);
    this.context = context;
    this.node = node;
    if (this.job) this.post({ kind: "frame", bytes: this.job.slice(0, 16) });
    if (this.listening) this.post({ kind: "frame", bytes: this.listening });
    if (this.bending) this.post({ kind: "frame", bytes: this.bending });
    for (const bytes of this.sounds) this.post({ kind: "frame", bytes });
  }
}

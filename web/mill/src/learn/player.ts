// SPDX-License-Identifier: MIT
// Plays one clip at a time. Another clip goes on where the one before was, without a gap.

import { RATE, type Clip } from "./clip.js";

const FADE_S = 0.03;

interface Playing {
  key: string;
  source: AudioBufferSourceNode;
  gain: GainNode;
  began: number; // on the clock of the context, less what was skipped
}

export class Player {
  private context: AudioContext | undefined;
  private now: Playing | undefined;

  /** `changed` is told what plays, or nothing. */
  constructor(private readonly changed: (key: string | undefined) => void) {}

  /** In a gesture. The same key again stops it. */
  toggle(key: string, clip: Clip): void {
    if (this.now?.key === key) return this.stop();
    const context = (this.context ??= new AudioContext());
    void context.resume();
    const buffer = new AudioBuffer({ length: clip[0].length, numberOfChannels: 2, sampleRate: RATE });
    for (const side of [0, 1] as const) buffer.copyToChannel(clip[side], side);
    const source = new AudioBufferSourceNode(context, { buffer });
    const gain = new GainNode(context, { gain: 0 });
    source.connect(gain).connect(context.destination);
    gain.gain.linearRampToValueAtTime(1, context.currentTime + FADE_S);
    const offset = this.now ? context.currentTime - this.now.began : 0;
    this.fade();
    const now = { key, source, gain, began: context.currentTime - offset };
    source.addEventListener("ended", () => {
      if (this.now === now) this.stop();
    });
    source.start(0, offset);
    this.now = now;
    this.changed(key);
  }

  stop(): void {
    this.fade();
    this.now = undefined;
    this.changed(undefined);
  }

  private fade(): void {
    if (!this.now || !this.context) return;
    const { gain, source } = this.now;
    const { currentTime } = this.context;
    gain.gain.cancelScheduledValues(currentTime);
    gain.gain.setTargetAtTime(0, currentTime, FADE_S / 3);
    source.stop(currentTime + 2 * FADE_S);
  }
}

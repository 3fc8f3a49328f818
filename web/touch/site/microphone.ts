// SPDX-License-Identifier: MIT
// An unchanged recording from the microphone: without echo, noise or gain control of the browser, and without
// compression.
import type { Sound } from "./sound.js";

const kCapture = `registerProcessor("capture", class extends AudioWorkletProcessor {
  process([[samples]]) { if (samples) this.port.postMessage(samples.slice()); return true; }
})`;

/** Waits `wait` seconds, so that the user can get ready, then records. Throws if there is no microphone. */
export async function record(seconds: number, wait: number): Promise<Sound> {
  if (navigator.mediaDevices === undefined)
    throw new Error("a page that is not secure may not use the microphone; open it by https");
  const stream = await navigator.mediaDevices.getUserMedia({
    audio: { echoCancellation: false, noiseSuppression: false, autoGainControl: false },
  });
  const context = new AudioContext();
  const blob = URL.createObjectURL(new Blob([kCapture], { type: "text/javascript" }));
  try {
    await context.audioWorklet.addModule(blob);
    const node = new AudioWorkletNode(context, "capture", {
      numberOfOutputs: 0,
      channelCount: 1,
      channelCountMode: "explicit",
    });
    const skip = Math.round(wait * context.sampleRate);
    const samples = new Float64Array(Math.round(seconds * context.sampleRate));
    let at = -skip;
    await new Promise<void>((full, fail) => {
      const late = setTimeout(() => fail(new Error("the microphone gives no sound")), 1000 * (wait + seconds) + 5000);
      node.port.onmessage = ({ data }: MessageEvent<Float32Array>) => {
        for (const sample of data) if (at++ >= 0 && at <= samples.length) samples[at - 1] = sample;
        if (at < samples.length) return;
        clearTimeout(late);
        full();
      };
      context.createMediaStreamSource(stream).connect(node);
      void context.resume();
    });
    return { rate: context.sampleRate, channels: 1, bits: 0, samples };
  } finally {
    URL.revokeObjectURL(blob);
    for (const track of stream.getTracks()) track.stop();
    void context.close();
  }
}

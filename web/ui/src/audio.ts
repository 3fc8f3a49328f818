// SPDX-License-Identifier: MIT
// Sound from a module in an AudioWorklet.

export interface Audio {
  context: AudioContext;
  node: AudioWorkletNode;
}

/** A stereo processor, made of `script`, that gets the module; it sounds once the context was resumed by a gesture. */
export async function openAudio(
  processor: string,
  script: string | URL,
  module: Promise<WebAssembly.Module>,
): Promise<Audio> {
  const context = new AudioContext({ latencyHint: "interactive" });
  if (context.audioWorklet === undefined) throw new Error("AudioWorklet needs a secure page (https or localhost)");
  const [compiled] = await Promise.all([module, context.audioWorklet.addModule(script)]);
  const node = new AudioWorkletNode(context, processor, {
    numberOfInputs: 0,
    outputChannelCount: [2],
    processorOptions: { module: compiled },
  });
  return { context, node };
}

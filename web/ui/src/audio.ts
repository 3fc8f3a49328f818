// SPDX-License-Identifier: MIT
// Sound from a module in an AudioWorklet.

export interface Audio {
  context: AudioContext;
  node: AudioWorkletNode;
}

/** Makes a stereo processor from `script` with the module. It sounds after a gesture has resumed the context. */
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

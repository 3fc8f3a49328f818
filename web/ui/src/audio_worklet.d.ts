// SPDX-License-Identifier: MIT
// What AudioWorkletGlobalScope has and TypeScript's page library does not know.

declare const sampleRate: number;

declare class AudioWorkletProcessor {
  readonly port: MessagePort;
}

declare function registerProcessor(
  name: string,
  processor: new (options: { processorOptions: { module: WebAssembly.Module } }) => AudioWorkletProcessor,
): void;

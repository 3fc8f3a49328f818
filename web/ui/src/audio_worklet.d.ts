// SPDX-License-Identifier: MIT
// Declarations of AudioWorkletGlobalScope that the DOM library of TypeScript does not contain.

declare const sampleRate: number;

declare class AudioWorkletProcessor {
  readonly port: MessagePort;
}

declare function registerProcessor(
  name: string,
  processor: new (options: { processorOptions: { module: WebAssembly.Module } }) => AudioWorkletProcessor,
): void;

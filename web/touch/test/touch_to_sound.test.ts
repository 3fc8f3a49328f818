// SPDX-License-Identifier: MIT
// From a finger's report to the sound of it, with what the page runs: the finger, the worklet, touch.wasm. Not
// counted: what the browser takes to deliver the report and what the system takes from the worklet to the ear.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { expect, test } from "vitest";
import { MODULES } from "../../tools/places.js";
import type { VoiceMessage } from "../src/audio.js";
import { Finger, type FingerReport } from "../src/fingers.js";
import { parseMaterial, voiceNumbers } from "../src/material.js";
import { material } from "./site.js";

const kRate = 48000;
const kFrames = 128;
const wasm = join(MODULES, "touch.wasm");

interface Worklet {
  port: { onmessage(event: { data: VoiceMessage }): void };
  process(inputs: Float32Array[][], outputs: Float32Array[][]): boolean;
}
type WorkletClass = new (options: { processorOptions: { module: unknown } }) => Worklet;

/** worklet.ts as an AudioWorkletGlobalScope would load it. */
async function workletClass(): Promise<WorkletClass> {
  let made: WorkletClass | undefined;
  Object.assign(globalThis, {
    sampleRate: kRate,
    AudioWorkletProcessor: class {
      port = {};
    },
    registerProcessor: (_name: string, type: WorkletClass) => (made = type),
  });
  await import("../src/worklet.js");
  return made!;
}

const report = (x: number, time: number): FingerReport => ({ x, y: 0, width: 0, height: 0, pressure: 0.3, time });

/** Mean power in steps of a quarter of a millisecond from the report on that shows the movement at 120 mm/s of a
 * finger that was down before; reports come at 60 Hz, the picture's loop asks for the speed right after. */
async function powerAfterTheReport(starts: number): Promise<number[]> {
  const kStep = 12;
  const kSteps = 400;
  const power = Array.from({ length: kSteps }, () => 0);
  const Processor = await workletClass();
  const module = await WebAssembly.compile(await readFile(wasm));
  const numbers = voiceNumbers(parseMaterial(material(), "https://example.org/m.json"));
  for (let start = 0; start < starts; ++start) {
    const worklet = new Processor({ processorOptions: { module } });
    const tell = (data: VoiceMessage) => worklet.port.onmessage({ data });
    const id = start + 1;
    tell({ kind: "add", id, numbers, published: false });
    const finger = new Finger(report(0, 0));
    // The report comes anywhere within a quantum.
    const told = 0.5 + 0.0003 * start;
    let next = told;
    const sound: number[] = [];
    for (let frame = 0; frame < (told + 0.105) * kRate; frame += kFrames) {
      const now = frame / kRate;
      for (; next <= now; next += 1 / 60) {
        finger.move(report(2 + 120 * (next - told), next));
        tell({ kind: "target", id, speed: finger.speed(next), force: finger.force(next), pan: 0, gain: 1 });
      }
      const out = [new Float32Array(kFrames), new Float32Array(kFrames)];
      worklet.process([], [out]);
      sound.push(...out[0]!);
    }
    const first = Math.floor(told * kRate);
    expect(sound.slice(0, first).every((v) => v === 0)).toBe(true);
    for (let n = 0; n < kStep * kSteps; ++n) power[Math.floor(n / kStep)]! += sound[first + n]! ** 2 / (kStep * starts);
  }
  return power;
}

test.skipIf(!existsSync(wasm))("a finger that begins to move is heard within 3 ms and a quantum", async () => {
  const power = await powerAfterTheReport(200);
  const steady = power.slice(320).reduce((sum, p) => sum + p / 80, 0);
  expect(steady).toBeGreaterThan(0);
  // Half of the power that it comes to in a tenth of a second, in the mean over three quarters of a millisecond.
  let heard = 0;
  while (power[heard]! + power[heard + 1]! + power[heard + 2]! < 1.5 * steady) ++heard;
  expect(0.25 * (heard + 1.5)).toBeLessThan(3 + (1000 * kFrames) / kRate);
});

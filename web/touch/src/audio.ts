// SPDX-License-Identifier: MIT
// Friction sound for all elements of a page: one AudioContext, one AudioWorkletNode. They are prepared before the
// first touch and start with the first gesture, as browsers require.
import { openAudio } from "@tribo/ui/audio";
import { engine } from "./engine.js";
import { voiceNumbers, type Material } from "./material.js";

/** Messages to the worklet. */
export type VoiceMessage =
  | { kind: "add"; id: number; numbers: Float64Array; published: boolean }
  | { kind: "target"; id: number; speed: number; force: number; pan: number; gain: number }
  | { kind: "remove"; id: number };

/** Message of the worklet about a voice that the module refuses. */
export interface VoiceRefusal {
  id: number;
  wrong: string;
}

type Fail = (error: unknown) => void;

let nextId = 1;

class Sound {
  readonly context: AudioContext;
  /** By voice. */
  readonly fails = new Map<number, Fail>();
  #node: AudioWorkletNode;

  constructor(context: AudioContext, node: AudioWorkletNode) {
    this.context = context;
    this.#node = node;
    node.connect(context.destination);
    node.port.onmessage = ({ data: { id, wrong } }: MessageEvent<VoiceRefusal>) =>
      this.fails.get(id)?.(new Error(`voices: ${wrong}`));
  }

  send(message: VoiceMessage): void {
    this.#node.port.postMessage(message);
  }

  /** Must be called in a gesture. */
  resume(): Promise<void> {
    return this.context.state === "running" ? Promise.resolve() : this.context.resume();
  }
}

let loading: Promise<Sound> | undefined;

async function load(): Promise<Sound> {
  if (typeof AudioContext === "undefined") throw new Error("Web Audio is not available");
  const module = engine().then((made) => made.module);
  const { context, node } = await openAudio("tribo-friction", new URL("./worklet.js", import.meta.url), module);
  return new Sound(context, node);
}

function sound(): Promise<Sound> {
  loading ??= load().catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

/** Starts the preparation of the sound. Errors are reported to the first voice. */
export function warmSound(): void {
  sound().catch(() => undefined);
}

/** The voice of one element. */
export class Voice {
  readonly id = nextId++;
  #sound: Sound | undefined;
  #freed = false;
  #ready: Promise<void>;

  /** `fail` receives the reason if the voice stays silent. */
  constructor(material: Material, published: boolean, fail: Fail) {
    this.#ready = sound().then((made) => {
      if (this.#freed) return;
      this.#sound = made;
      made.fails.set(this.id, fail);
      made.send({ kind: "add", id: this.id, numbers: voiceNumbers(material), published });
    });
    this.#ready.catch(fail);
  }

  /** Must be called in a gesture: browsers start sound only there. */
  wake(): void {
    void this.#ready.then(() => this.#sound?.resume()).catch(() => undefined);
  }

  /** Speed in mm/s, force in N, pan -1 (left) to 1, gain 1 for the recorded level. */
  target(speed: number, force: number, pan: number, gain = 1): void {
    this.#sound?.send({ kind: "target", id: this.id, speed, force, pan, gain });
  }

  free(): void {
    this.#freed = true;
    this.#sound?.fails.delete(this.id);
    this.#sound?.send({ kind: "remove", id: this.id });
    this.#sound = undefined;
  }

  /** Latency between the worklet and the ear in seconds, as stated by the system. */
  get latency(): number {
    const context = this.#sound?.context;
    return context === undefined ? 0 : context.baseLatency + (context.outputLatency ?? 0);
  }
}

// SPDX-License-Identifier: MIT
// The mill without an engine: tribo.wasm in a worker of this page.

import { decodeFrame } from "@tribo/protocol/frames";
import type { Command, Settings } from "@tribo/protocol/messages";
import type { AuditOfMill } from "@tribo/wasm/audit";
import type { Listener, Source } from "./source.js";

export interface JobFile {
  name: string;
  bytes: ArrayBuffer;
  /** It is one of the examples beside the page. */
  beside?: boolean;
}

// The job or program among the files, and optionally a model as its designed surface.
export interface Order {
  files: JobFile[];
  job: string;
  part: string;
  cell: number; // mm; 0: the default spacing of the job
}

/** What a set-up is made of: the job as text, and the names that it may hold. */
export interface SetUp {
  text: string;
  machines: string[];
  materials: string[];
}

export type ToWorker = { kind: "open"; order: Order } | { kind: "command"; command: Command } | { kind: "set-up" };
export type FromWorker =
  | { kind: "opened"; job: string; version: string; warnings: string[]; materials: string[] }
  | { kind: "settings"; settings: Settings }
  | { kind: "no"; why: string }
  // With a set-up: all that the program lacks is its machine.
  | { kind: "refused"; why: string; lacksMachine?: SetUp }
  | { kind: "set-up"; setUp: SetUp | undefined }
  | { kind: "failed"; why: string }
  | { kind: "audit"; audit: AuditOfMill; lines: Float64Array }
  | { kind: "frames"; frames: ArrayBuffer[] };

export interface Refusal {
  why: string;
  lacksMachine?: SetUp;
}

export class Workshop implements Source {
  private readonly worker: Worker;
  private readonly waiting: ((refusal: Refusal | undefined) => void)[] = [];
  private readonly asked: ((setUp: SetUp | undefined) => void)[] = [];

  constructor(private readonly listener: Listener) {
    this.worker = new Worker(new URL("./workshop_worker.ts", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.take(data);
    this.worker.onerror = (event) => this.listener.line(false, event.message || "the page's own mill failed");
  }

  // Returns the reason of a refusal, or undefined.
  open(order: Order): Promise<Refusal | undefined> {
    this.post({ kind: "open", order });
    return new Promise((resolve) => this.waiting.push(resolve));
  }

  /** The set-up of the open job; undefined: there is none. */
  setUp(): Promise<SetUp | undefined> {
    this.post({ kind: "set-up" });
    return new Promise((resolve) => this.asked.push(resolve));
  }

  send(command: Command): void {
    this.post({ kind: "command", command });
  }

  close(): void {
    this.worker.terminate();
  }

  private post(message: ToWorker): void {
    this.worker.postMessage(message);
  }

  private take(message: FromWorker): void {
    switch (message.kind) {
      case "opened":
        this.listener.line(true, "");
        this.listener.info({
          op: "serverInfo",
          version: message.version,
          job: message.job,
          warnings: message.warnings,
          materials: message.materials,
        });
        this.waiting.shift()?.(undefined);
        break;
      case "refused":
        this.waiting.shift()?.(message);
        break;
      case "set-up":
        this.asked.shift()?.(message.setUp);
        break;
      case "failed":
        this.waiting.shift()?.({ why: message.why });
        this.listener.line(false, message.why);
        break;
      case "settings":
        this.listener.settings(message.settings);
        break;
      case "no":
        this.listener.refused(message.why);
        break;
      case "audit":
        this.listener.audit(message.audit, message.lines);
        break;
      case "frames":
        for (const bytes of message.frames) this.listener.frame(decodeFrame(bytes), bytes);
        break;
    }
  }
}

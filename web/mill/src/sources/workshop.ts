// SPDX-License-Identifier: MIT
// The mill without an engine: tribo.wasm in a worker of this page.

import { decodeFrame } from "@tribo/protocol/frames";
import type { Command, Settings } from "@tribo/protocol/messages";
import type { AuditOfMill } from "@tribo/wasm/audit";
import type { Listener, Source } from "./source.js";

export interface JobFile {
  name: string;
  bytes: ArrayBuffer;
}

// The job or program among the files, and optionally a model as its designed surface.
export interface Order {
  files: JobFile[];
  job: string;
  part: string;
  cell: number; // mm; 0: the default spacing of the job
}

export type ToWorker = { kind: "open"; order: Order } | { kind: "command"; command: Command };
export type FromWorker =
  | { kind: "opened"; job: string; version: string; warnings: string[]; materials: string[] }
  | { kind: "settings"; settings: Settings }
  | { kind: "no"; why: string }
  | { kind: "refused"; why: string }
  | { kind: "failed"; why: string }
  | { kind: "audit"; audit: AuditOfMill; lines: Float64Array }
  | { kind: "frames"; frames: ArrayBuffer[] };

export class Workshop implements Source {
  private readonly worker: Worker;
  private readonly waiting: ((refusal: string) => void)[] = [];

  constructor(private readonly listener: Listener) {
    this.worker = new Worker(new URL("./workshop_worker.ts", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.take(data);
    this.worker.onerror = (event) => this.listener.line(false, event.message || "the page's own mill failed");
  }

  // Returns the reason of a refusal, or undefined.
  open(order: Order): Promise<string> {
    this.post({ kind: "open", order });
    return new Promise((resolve) => this.waiting.push(resolve));
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
        this.waiting.shift()?.("");
        break;
      case "refused":
        this.waiting.shift()?.(message.why);
        break;
      case "failed":
        this.waiting.shift()?.(message.why);
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

// SPDX-License-Identifier: MIT
// A source of frames that takes commands: an engine, the module in this page, or a recording. The page is the same
// for all.

import type { AuditOfMill } from "@tribo/wasm/audit";
import type { Frame } from "@tribo/protocol/frames";
import type { Command, Files, ServerInfo, Settings } from "@tribo/protocol/messages";

export interface Listener {
  // `bytes` is the undecoded frame; it may be kept.
  frame(frame: Frame, bytes: ArrayBuffer): void;
  info(info: ServerInfo): void;
  settings(settings: Settings): void;
  // Reports whether the source is connected; `why` is a text for users.
  line(open: boolean, why: string): void;
  // Reports a fault in the files of the job, which were read again; null: there is none any more.
  files(news: Files): void;
  // Reports the audit of the rows so far, with the lines of MillAudit. An engine and a recording do not send it.
  audit(audit: AuditOfMill, lines: Float64Array): void;
  // Reports a refused command with the reason.
  refused(why: string): void;
}

export interface Source {
  send(command: Command): void;
  close(): void;
}

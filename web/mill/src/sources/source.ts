// SPDX-License-Identifier: MIT
// A source of frames that takes commands: an engine, the module in this page, or a recording. The page is the same
// for all.

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
  // Reports a refused command with the reason.
  refused(why: string): void;
}

export interface Source {
  send(command: Command): void;
  close(): void;
}

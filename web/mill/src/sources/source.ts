// SPDX-License-Identifier: MIT
// Where frames come from and commands go to: an engine, the module in this page, or a recording. The page
// behind it is the same.

import type { Frame } from "@tribo/protocol/frames";
import type { Command, ServerInfo, Settings } from "@tribo/protocol/messages";

export interface Listener {
  // `bytes` are the frame as it came; they may be kept.
  frame(frame: Frame, bytes: ArrayBuffer): void;
  info(info: ServerInfo): void;
  settings(settings: Settings): void;
  // Whether there is a line; `why` is for people.
  line(open: boolean, why: string): void;
  // What was asked for is not done, and why.
  refused(why: string): void;
}

export interface Source {
  send(command: Command): void;
  close(): void;
}

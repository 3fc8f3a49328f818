// SPDX-License-Identifier: MIT
// Where frames come from and commands go to: an engine, the module in this page, or a recording. The page
// behind it is the same.

import type { Frame } from "./frames.js";

export type Command =
  | { op: "play" | "pause" | "resync" | "stop" | "release" }
  | { op: "speed"; value: number }
  | { op: "seek"; t_s: number }
  | { op: "finger"; position_mm: number[]; down: boolean }
  | { op: "mode"; value: "cut" | "inspect" }
  | { op: "force"; value: boolean }
  | { op: "set"; key: string; value: number }
  | { op: "material"; value: string };

export interface ServerInfo {
  op: "serverInfo";
  version: string;
  // None: the page mills what is dropped into it.
  job?: string;
  warnings: string[];
  materials?: string[];
  // Who sounds; without a word, the page.
  audio?: "browser" | "native" | "off";
  device?: { name: string; max_force_n: number; rate_hz: number; arm: boolean };
}

// What is set, as all who watch share it.
export interface Settings {
  op: "settings";
  feed_percent: number;
  spindle_percent: number;
  helix_deg: number;
  force_scale: number;
  jnd: number;
  material: string;
  mode: "cut" | "inspect";
  force: boolean;
  stopped: boolean;
}

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

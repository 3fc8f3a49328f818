// SPDX-License-Identifier: MIT
// The texts of the live view (docs/live-protocol.md).

export const SUBPROTOCOL = "tribo.live.1";

export type Mode = "cut" | "inspect";

/** Values of the sliders. */
export type Setting = "feed_percent" | "spindle_percent" | "helix_deg" | "force_scale" | "jnd";

export type Command =
  | { op: "play" | "pause" | "resync" | "stop" | "release" }
  | { op: "speed"; value: number }
  | { op: "seek"; t_s: number }
  | { op: "finger"; position_mm: [number, number, number]; down: boolean }
  | { op: "mode"; value: Mode }
  | { op: "force" | "cases"; value: boolean }
  | { op: "set"; key: Setting; value: number }
  | { op: "material"; value: string };

export interface ServerInfo {
  op: "serverInfo";
  version: string;
  /** Absent: the page mills the files dropped into it. */
  job?: string;
  warnings: string[];
  materials?: string[];
  /** Absent: the page plays the sound. */
  audio?: "browser" | "native" | "off";
  device?: { name: string; max_force_n: number; rate_hz: number; arm: boolean };
  /** Valid for one reconnection, instead of the token of the page. */
  resume?: string;
}

/** The settings, shared by all viewers. */
export interface Settings extends Record<Setting, number> {
  op: "settings";
  material: string;
  mode: Mode;
  force: boolean;
  stopped: boolean;
  /** Something of the job is known with a spread only. Earlier engines do not send it, nor the next. */
  has_spread?: boolean;
  /** The cases from which bands come; 0: the spread of the coefficients alone. */
  cases?: number;
}

export interface Refused {
  op: "refused";
  why: string;
  remedy?: string;
}

/** A fault in the files of the job. `line` and `column` count from 1; 0: none. */
export interface FileFault {
  file: string;
  line: number;
  column: number;
  why: string;
  remedy: string;
}

/** The files were read again. With a fault the cut before goes on; null: they are good. */
export interface Files {
  op: "files";
  wrong: FileFault | null;
  /** Of the cut that is milled now. */
  warnings: string[];
}

/** Frames were dropped; `resync` requests them again. */
export interface Lost {
  op: "lost";
}

export type EngineMessage = ServerInfo | Settings | Refused | Files | Lost;

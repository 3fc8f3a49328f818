// SPDX-License-Identifier: MIT
// The texts of the live view (docs/live-protocol.md).

export const SUBPROTOCOL = "tribo.live.1";

export type Mode = "cut" | "inspect";

/** What a slider sets. */
export type Setting = "feed_percent" | "spindle_percent" | "helix_deg" | "force_scale" | "jnd";

export type Command =
  | { op: "play" | "pause" | "resync" | "stop" | "release" }
  | { op: "speed"; value: number }
  | { op: "seek"; t_s: number }
  | { op: "finger"; position_mm: [number, number, number]; down: boolean }
  | { op: "mode"; value: Mode }
  | { op: "force"; value: boolean }
  | { op: "set"; key: Setting; value: number }
  | { op: "material"; value: string };

export interface ServerInfo {
  op: "serverInfo";
  version: string;
  /** None: the page mills what is dropped into it. */
  job?: string;
  warnings: string[];
  materials?: string[];
  /** Who sounds; without a word, the page. */
  audio?: "browser" | "native" | "off";
  device?: { name: string; max_force_n: number; rate_hz: number; arm: boolean };
  /** Good for one return, in place of the page's own token. */
  resume?: string;
}

/** What is set, as all who watch share it. */
export interface Settings extends Record<Setting, number> {
  op: "settings";
  material: string;
  mode: Mode;
  force: boolean;
  stopped: boolean;
}

export interface Refused {
  op: "refused";
  why: string;
  remedy?: string;
}

/** Frames were dropped: `resync` brings them again. */
export interface Lost {
  op: "lost";
}

export type EngineMessage = ServerInfo | Settings | Refused | Lost;

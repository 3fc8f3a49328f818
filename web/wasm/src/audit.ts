// SPDX-License-Identifier: MIT
// The audit of the mill in a page (docs/audit.md): what mill_audit() of tribo.wasm gives, with the keys of audit.json.
import type { MillExports } from "./exports.js";
import { textAt } from "./memory.js";

/** Low end, value and high end. */
export type Band = [low: number, value: number, high: number];

/** A load with the unit in its key. `multiplier` is that of a small vibration: above 1 it grows. */
export const LOADS = [
  "peak_force_n",
  "peak_torque_nm",
  "power_w",
  "stress_n_per_mm2",
  "deflection_mm",
  "chip_mm",
  "multiplier",
] as const;
export type Load = (typeof LOADS)[number];

/** "undecided": the band of a load spans its limit. */
export type Outcome = "nothing cut" | "within" | "undecided" | "over";

export interface AuditFinding {
  outcome: Outcome;
  /** A clause that begins with the place. */
  text: string;
  /** None: of no line alone. */
  line?: number;
  ratio?: Band;
}

/** Without `value`: it follows the speed of the spindle. Without `band`: exact. */
export interface AuditLimit {
  value?: number;
  band?: [low: number, high: number];
  from: string;
  rule_of_thumb?: true;
}

/** The largest value. `ratio`: over its limit, where there is one. `line`: of it, for a tool. */
export interface AuditPeak {
  value: number;
  ratio?: Band;
  line?: number;
}

export interface AuditTally extends Partial<Record<Load, AuditPeak>> {
  /** Number of the tool; 0: without one. */
  tool: number;
  t_s: number;
  feed_mm: number;
  feed_s: number;
  cutting_s: number;
  removed_mm3: number;
  rubbing_s: number;
  plunge_deg: number;
  jump_n: number;
  entries: number;
  collisions: number;
}

export interface AuditLine extends AuditTally {
  line: number;
}

export interface AuditTool extends AuditTally {
  /** As --tool of the program takes it. */
  cutter: string;
  limits: Partial<Record<Load, AuditLimit>> & { least_chip_mm: AuditLimit };
}

/** Of the program up to `duration_s`. Times are those of the program without overrides. */
export interface AuditOfMill {
  verdict: { outcome: Outcome; sentence: string; findings: AuditFinding[] };
  chatter_probability?: number;
  /** Factors on all forces: the band of the material. */
  force_band: [low: number, high: number];
  duration_s: number;
  feed_s: number;
  cutting_s: number;
  air_share: number;
  /** Number of lines that moved; one that runs again counts again. */
  lines: number;
  tolerance_mm?: number;
  lines_over: Partial<Record<Load, { over: number; undecided: number }>>;
  tools: AuditTool[];
  /** Those first that are nearest to a limit, or farthest over it; at most 50. */
  worst: AuditLine[];
  collisions: { line: number; t_s: number; kind: string; tip_mm: [number, number, number] }[];
}

/** The numbers of each line at mill_audit_lines(), in this order. A ratio of 0: the load has no limit. */
export const AUDIT_COLUMNS = [
  "line",
  "t_s",
  "duration_s",
  "tool",
  "spindle_rpm",
  "feed_mm",
  "feed_s",
  "cutting_s",
  "removed_mm3",
  ...LOADS,
  "peak_force_n_ratio",
  "peak_torque_nm_ratio",
  "power_w_ratio",
  "stress_n_per_mm2_ratio",
  "deflection_mm_ratio",
  "chip_mm_ratio",
  "multiplier_ratio",
  "rubbing_s",
  "plunge_deg",
  "jump_n",
  "entries",
  "collisions",
] as const;
export type AuditColumn = (typeof AUDIT_COLUMNS)[number];

export interface MillAudit {
  audit: AuditOfMill;
  /** The JSON of `audit`. */
  text: string;
  /** Rows of AUDIT_COLUMNS, in the order of time. A copy. */
  lines: Float64Array<ArrayBuffer>;
}

/** Audits what the open mill has milled so far. Throws without a job. */
export function auditOf(mill: MillExports): MillAudit {
  const good = mill.mill_audit();
  const text = textAt(mill, mill.mill_text());
  if (good === 0) throw new Error(text);
  const audit = JSON.parse(text) as AuditOfMill;
  const count = audit.lines * AUDIT_COLUMNS.length;
  return { audit, text, lines: new Float64Array(mill.memory.buffer, mill.mill_audit_lines(), count).slice() };
}

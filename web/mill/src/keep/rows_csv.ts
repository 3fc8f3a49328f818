// SPDX-License-Identifier: MIT
// The rows of the cut as a CSV file, with the units in the names.

import type { Row } from "@tribo/protocol/frames";

const DEGREES = 180 / Math.PI;
const COLUMNS: [string, (row: Row) => number | string][] = [
  ["t_s", (row) => row.time],
  ["duration_s", (row) => row.duration],
  ["line", (row) => row.line],
  ["tip_x_mm", (row) => row.tip[0]],
  ["tip_y_mm", (row) => row.tip[1]],
  ["tip_z_mm", (row) => row.tip[2]],
  ["spindle_rpm", (row) => row.rpm],
  ["mean_force_n", (row) => row.meanForce],
  ["peak_force_n", (row) => row.peakForce],
  ["torque_nm", (row) => row.torque],
  ["axial_depth_mm", (row) => row.depth],
  ["entry_deg", (row) => row.entry * DEGREES],
  ["exit_deg", (row) => row.exit * DEGREES],
  ["feed_per_tooth_mm", (row) => row.feedPerTooth],
  ["chip_mm", (row) => row.chip],
  ["multiplier", (row) => row.multiplier || ""],
];

// The frames have single precision.
const written = (value: number | string) => (typeof value === "string" ? value : String(Number(value.toPrecision(8))));

export function rowsCsv(rows: readonly Row[]): string {
  const lines = rows.map((row) => COLUMNS.map(([, of]) => written(of(row))).join());
  return [COLUMNS.map(([name]) => name).join(), ...lines, ""].join("\n");
}

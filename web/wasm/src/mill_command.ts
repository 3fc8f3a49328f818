// SPDX-License-Identifier: MIT
// Commands of a page (docs/live-protocol.md) to its own mill, the same as the JSON commands of an engine.

import type { MillExports } from "./exports.js";
import { lendText } from "./memory.js";

export interface MillCommand {
  op: string;
  value?: number | boolean | string;
  t_s?: number;
  position_mm?: [number, number, number];
  down?: boolean;
  key?: string;
}

/** Returns true if the command was executed; else mill_text() has the reason. */
export function obey(x: MillExports, { op, value, t_s, position_mm, down, key }: MillCommand): boolean {
  const number = typeof value === "number" ? value : (t_s ?? NaN);
  const on = value === true || down === true;
  const word = typeof value === "string" ? value : (key ?? "");
  const place = position_mm ?? ([0, 0, 0] as const);
  return lendText(x, op, (...name) =>
    lendText(x, word, (...said) => x.mill_command(...name, number, Number(on), ...place, ...said) === 1),
  );
}

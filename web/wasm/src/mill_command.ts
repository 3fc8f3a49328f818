// SPDX-License-Identifier: MIT
// A page's commands (docs/live-protocol.md) to its own mill, as an engine gets them in JSON.

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

/** Whether it was obeyed; mill_text() says why not. */
export function obey(x: MillExports, { op, value, t_s, position_mm, down, key }: MillCommand): boolean {
  const number = typeof value === "number" ? value : (t_s ?? NaN);
  const on = value === true || down === true;
  const word = typeof value === "string" ? value : (key ?? "");
  const place = position_mm ?? ([0, 0, 0] as const);
  return lendText(x, op, (...name) =>
    lendText(x, word, (...said) => x.mill_command(...name, number, Number(on), ...place, ...said) === 1),
  );
}

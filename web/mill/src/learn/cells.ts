// SPDX-License-Identifier: MIT
// What is heard of a cut, as a row of a table.

import { fixed } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";
import type { Heard } from "./measure.js";

// Tones that are weaker cannot be told from the noise.
const FAINT_DB = -42;

/** The columns of a table of what is heard. */
export const COLUMNS = [
  word("level"),
  word("tones of the teeth"),
  word("tones of the turn"),
  word("strongest other tone"),
  word("hiss"),
];

/** A cell for each column, dB. */
export function cellsOf(heard: Heard): string[] {
  const level = (db: number) => (db < FAINT_DB ? t("none") : fixed(db, 1));
  const tone = { db: level(heard.tone_db), hz: fixed(heard.tone_hz, 0) };
  return [
    fixed(heard.level_db, 1),
    level(heard.teeth_db),
    level(heard.turn_db),
    heard.tone_db < FAINT_DB ? tone.db : t("{db} at {hz} Hz", tone),
    fixed(heard.hiss_db, 1),
  ];
}

// SPDX-License-Identifier: MIT
// Numbers for the eye: lengths in millimetres or inches, as the user chooses, and the decimal sign of the language. Inside
// all lengths are millimetres. Forces are newtons in both.

import { recall, remember } from "../page.js";
import { language } from "./texts.js";

export type LengthUnit = "mm" | "in";

const MM_PER_INCH = 25.4;
// No force and no length of a cut is known better.
const DIGITS = 3;
const KEPT = "units";
let chosen: LengthUnit = recall(KEPT) === "in" ? "in" : "mm";
const listeners: (() => void)[] = [];

export function chooseUnit(unit: LengthUnit): void {
  chosen = unit;
  remember(KEPT, unit);
  for (const changed of listeners) changed();
}
/** Called when another unit is chosen. */
export function onUnit(changed: () => void): void {
  listeners.push(changed);
}
export const lengthUnit = (): LengthUnit => chosen;
export const feedUnit = (): string => `${chosen}/min`;
export const volumeUnit = (): string => (chosen === "in" ? "in³" : "cm³");

/** With so many decimals, but no more than three digits in all, and the decimal sign of the language. */
export function fixed(value: number, decimals: number): string {
  const rounded = Number(value.toPrecision(DIGITS));
  const whole = Math.floor(Math.log10(Math.abs(rounded))) + 1;
  return local(rounded.toFixed(Math.min(decimals, Math.max(DIGITS - whole, 0))));
}
/** With so many digits in all. */
export function precise(value: number, digits: number): string {
  return local(String(Number(value.toPrecision(digits))));
}
const local = (text: string) => (language === "de" ? text.replace(".", ",") : text);

const inUnit = (mm: number) => (chosen === "in" ? mm / MM_PER_INCH : mm);
const inDecimals = (decimals: number) => (chosen === "in" ? decimals + 1 : decimals);
/** A length as a number, with the decimals that it has in millimetres: an inch takes one more. */
export function length(mm: number, decimals: number): string {
  return fixed(inUnit(mm), inDecimals(decimals));
}
/** A length between places that the user chose, however long. */
export function distance(mm: number): string {
  return local(inUnit(mm).toFixed(inDecimals(2)));
}
/** A length with its unit. */
export function lengthWords(mm: number, decimals: number): string {
  return `${length(mm, decimals)} ${chosen}`;
}
/** A length of which as many digits count as are given. */
export function preciseLength(mm: number, digits: number): string {
  return `${precise(inUnit(mm), digits)} ${chosen}`;
}
/** A speed that the program sets, mm/min. */
export function feed(mmPerMin: number): string {
  return local(inUnit(mmPerMin).toFixed(inDecimals(0)));
}
/** A volume, mm3. */
export function volume(mm3: number): string {
  return chosen === "in" ? fixed(mm3 / MM_PER_INCH ** 3, 3) : fixed(mm3 / 1000, 2);
}

/** For fields, which take a decimal point: the value of a length, and the length of a value, mm. */
export function toField(mm: number): string {
  return String(chosen === "in" ? Number((mm / MM_PER_INCH).toPrecision(7)) : mm);
}
// A digit less, so that a round number of millimetres comes back as one.
export function fromField(value: number): number {
  return chosen === "in" ? Number((value * MM_PER_INCH).toPrecision(6)) : value;
}

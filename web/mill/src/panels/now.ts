// SPDX-License-Identifier: MIT
// The cut at the clock: one large number with its band, and what stands beside it.

import type { Row, StateFrame } from "@tribo/protocol/frames";
import { AUDIT_COLUMNS, LOADS, type Load } from "@tribo/wasm/audit";
import { element } from "@tribo/ui/dom";
import { feed, feedUnit, fixed, length, lengthUnit, onUnit, precise, volume, volumeUnit } from "../texts/figures.js";
import { t, word } from "../texts/texts.js";

function write(id: string, value: string, unit = ""): void {
  const place = element(id);
  const text = unit ? `${value} ${unit}` : value;
  if (place.textContent === text) return;
  place.textContent = unit ? `${value} ` : value;
  if (!unit) return;
  const small = document.createElement("small");
  small.textContent = unit;
  place.append(small);
}

/** Two values that mean a band: no more digits than the band is wide. */
export function bandWords(low: number, high: number): string {
  const digits = Math.max(0, Math.floor(Math.log10(Math.max(high - low, 1))) - 1);
  const round = (v: number) => (Math.round(v / 10 ** digits) * 10 ** digits).toFixed(0);
  return t("{low} to {high}", { low: round(low), high: round(high) });
}

/** Power at the spindle, W. */
export const powerOf = ({ torque, rpm }: { torque: number; rpm: number }): number => torque * rpm * (Math.PI / 30);

const LOAD_WORDS: Record<Load, string> = {
  peak_force_n: word("of the force limit"),
  peak_torque_nm: word("of the torque limit"),
  power_w: word("of the power limit"),
  stress_n_per_mm2: word("of the strength limit"),
  deflection_mm: word("of the bending limit"),
  chip_mm: word("of the chip limit"),
  multiplier: word("of the chatter limit"),
};

export interface Share {
  load: Load;
  ratio: number;
}

/** The load of each line that is nearest to its limit. */
export function sharesOf(lines: Float64Array): Map<number, Share> {
  const shares = new Map<number, Share>();
  const columns = LOADS.map((load) => AUDIT_COLUMNS.indexOf(`${load}_ratio`));
  for (let row = 0; row + AUDIT_COLUMNS.length <= lines.length; row += AUDIT_COLUMNS.length) {
    const line = lines[row]!;
    columns.forEach((column, k) => {
      const ratio = lines[row + column]!;
      if (ratio > (shares.get(line)?.ratio ?? 0)) shares.set(line, { load: LOADS[k]!, ratio });
    });
  }
  return shares;
}

export class Now {
  private shares = new Map<number, Share>();
  private spreads = false;
  // End of the axis, N.
  private highest = 0;
  private again: (() => void) | undefined;

  constructor() {
    onUnit(() => this.again?.());
  }

  begin(): void {
    this.again = undefined;
    this.shares.clear();
    this.forgetRows();
  }
  forgetRows(): void {
    this.spreads = false;
    this.highest = 0;
  }
  audit(lines: Float64Array): void {
    this.shares = sharesOf(lines);
    this.again?.();
  }
  addRows(rows: readonly Row[]): void {
    for (const { peakForce, peakLow, peakHigh } of rows) {
      this.spreads ||= peakLow < peakHigh;
      this.highest = Math.max(this.highest, peakForce, peakHigh);
    }
  }

  // `row` is the cut at the clock.
  show(state: StateFrame, row: Row | undefined): void {
    this.again = () => this.show(state, row);
    write("peak", fixed(state.peakForce, 0), "N");
    element("band").hidden = element("band-row").hidden = !this.spreads;
    if (this.spreads) {
      const low = row?.peakLow ?? 0;
      const high = row?.peakHigh ?? 0;
      const at = (force: number) => `${Math.min((100 * force) / Math.max(this.highest, 1), 100)}%`;
      const range = element("band-range");
      range.style.left = at(low);
      range.style.right = `calc(100% - ${at(high)})`;
      element("band-mark").style.left = at(state.peakForce);
      write("could-be", state.cutting ? bandWords(low, high) : "0", "N");
    }
    const share = this.shares.get(state.line);
    element("share-row").hidden = share === undefined;
    if (share) {
      write("share", `${fixed(100 * share.ratio, 0)} %`);
      element("share-row").title = t("Of the whole line, at its worst");
      element("share-of").textContent = t(LOAD_WORDS[share.load]);
    }
    write("power", state.cutting ? fixed(powerOf(state), 0) : "0", "W");
    write("depth", row ? length(row.depth, 2) : "0", lengthUnit());
    write("chip", row && row.chip > 0 ? length(row.chip, 3) : "0", lengthUnit());
    if (state.rapid) write("feed", t("rapid"));
    else write("feed", feed(state.feed), feedUnit());
    write("removed", volume(state.removed), volumeUnit());
    write("line", String(state.line));
    write("force", fixed(Math.hypot(...state.force), 0), "N");
    write("torque", fixed(state.torque, 2), "Nm");
    write("spindle", precise(state.rpm, 5), t("rpm"));
  }
}

// SPDX-License-Identifier: MIT
// The verdict on the cut so far, in one sentence, and the places to look at. Red is for damage only.

import type { CollisionFrame, Row } from "@tribo/protocol/frames";
import type { AuditOfMill } from "@tribo/wasm/audit";
import { element } from "@tribo/ui/dom";
import { fixed, lengthWords } from "../texts/figures.js";
import { t } from "../texts/texts.js";
import type { ChipMark } from "../sight/heat_map.js";

export interface Facts {
  collisions: readonly Pick<CollisionFrame, "time" | "line" | "what">[];
  chips: readonly ChipMark[];
  // The rows with the largest force and the largest multiplier.
  strongest: Pick<Row, "time" | "line" | "peakForce"> | undefined;
  wildest: Pick<Row, "time" | "line" | "multiplier"> | undefined;
  // Where the source audits: the limits of cutter, spindle and part.
  audit: Pick<AuditOfMill, "verdict" | "tools"> | undefined;
  // All of the program is milled.
  whole: boolean;
}

export interface Place {
  kind: "damage" | "overload" | "rubbing" | "load";
  words: string;
  line: number;
  // Undefined: when the line first runs.
  time: number | undefined;
}

export interface Judged {
  sentence: string;
  damage: boolean;
  places: Place[];
}

const MOST_PLACES = 3;
const lines = (count: number) => (count === 1 ? t("1 line") : t("{count} lines", { count }));
const atLine = (line: number, what: string) => t("line {line}: {what}", { line, what });
const small = (text: string) => `${text[0]!.toLowerCase()}${text.slice(1)}`;

// What the page itself knows.
function seen({ collisions, chips, strongest, wildest }: Facts): Judged {
  const places: Place[] = [];
  const [hit] = collisions;
  if (hit) {
    const more = collisions.length > 1 ? t(", and {count} more", { count: collisions.length - 1 }) : "";
    places.push({ kind: "damage", words: `${atLine(hit.line, hit.what)}${more}`, line: hit.line, time: hit.time });
  }
  const chatters = wildest !== undefined && wildest.multiplier > 1;
  if (chatters) {
    const words = atLine(wildest.line, t("chatters most, multiplier {mu}", { mu: fixed(wildest.multiplier, 2) }));
    places.push({ kind: "overload", words, line: wildest.line, time: wildest.time });
  }
  const thick = chips.filter(({ verdict }) => verdict === "overload").sort((a, b) => b.chip - a.chip);
  if (thick[0]) {
    const said = { chip: lengthWords(thick[0].chip, 3), lines: lines(thick.length) };
    const words = atLine(thick[0].line, t("chip of {chip}; {lines} overload a tooth", said));
    places.push({ kind: "overload", words, line: thick[0].line, time: thick[0].time });
  }
  if (strongest) {
    const words = atLine(strongest.line, t("highest load, {force} N", { force: fixed(strongest.peakForce, 0) }));
    places.push({ kind: "load", words, line: strongest.line, time: strongest.time });
  }
  const thin = chips.filter(({ verdict }) => verdict === "rubbing").sort((a, b) => a.chip - b.chip);
  if (thin[0]) {
    const words = atLine(thin[0].line, t("the edge rubs, on {lines}", { lines: lines(thin.length) }));
    places.push({ kind: "rubbing", words, line: thin[0].line, time: thin[0].time });
  }
  let sentence = t("Nothing is cut yet.");
  if (hit) sentence = t("The tool hits what it must not.");
  else if (chatters) sentence = t("The cut chatters.");
  else if (thick[0]) sentence = t("Teeth are overloaded.");
  else if (strongest) sentence = t("No collision, no overloaded tooth.");
  return { sentence, damage: hit !== undefined, places };
}

export function judge(facts: Facts): Judged {
  const { sentence, damage, places } = seen(facts);
  const soFar = (text: string) =>
    facts.strongest && !facts.whole ? t("So far, {verdict}", { verdict: small(text) }) : text;
  const { audit } = facts;
  if (!audit || !facts.strongest) return { sentence: soFar(sentence), damage, places: places.slice(0, MOST_PLACES) };
  // A stress that is over its limit for sure, at the low ends of both bands.
  const breaks = audit.tools.some(({ stress_n_per_mm2: stress }) => (stress?.ratio?.[0] ?? 0) > 1);
  // A finding without a ratio at the line of a collision is that collision.
  const [hit] = facts.collisions;
  const found = audit.verdict.findings.flatMap(({ outcome, text, line, ratio }): Place[] =>
    line === undefined || (line === hit?.line && ratio === undefined)
      ? []
      : [{ kind: outcome === "over" ? "overload" : "load", words: text, line, time: undefined }],
  );
  const all = [...places.filter(({ kind }) => kind === "damage"), ...found];
  const known = new Set(all.map((place) => place.line));
  all.push(...places.filter(({ kind, line }) => kind !== "damage" && !known.has(line)));
  return { sentence: soFar(audit.verdict.sentence), damage: damage || breaks, places: all.slice(0, MOST_PLACES) };
}

export class Verdict {
  private before = "";
  /** The place that it names first. */
  worst: Place | undefined;

  constructor(private readonly go: (place: Place) => void) {}

  show(facts: Facts): void {
    const judged = judge(facts);
    this.worst = judged.places[0];
    const now = JSON.stringify(judged);
    if (now === this.before) return;
    this.before = now;
    element("verdict").dataset.damage = String(judged.damage);
    // The first sentence is the verdict; what follows explains it.
    const [first = "", ...rest] = judged.sentence.split(/(?<=\.) /);
    element("verdict-sentence").textContent = first;
    element("verdict-rest").textContent = rest.join(" ");
    element("verdict-places").replaceChildren(
      ...judged.places.map((place) => {
        const item = document.createElement("li");
        const button = document.createElement("button");
        button.type = "button";
        button.dataset.kind = place.kind;
        button.textContent = place.words;
        button.addEventListener("click", () => this.go(place));
        item.append(button);
        return item;
      }),
    );
  }
}

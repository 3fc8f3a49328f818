// SPDX-License-Identifier: MIT
// The verdict on the cut so far, in one sentence, and the places to look at. Red is for damage only.

import type { CollisionFrame, Row } from "@tribo/protocol/frames";
import type { AuditOfMill } from "@tribo/wasm/audit";
import { element } from "@tribo/ui/dom";
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
const lines = (count: number) => (count === 1 ? "1 line" : `${count} lines`);
const small = (text: string) => `${text[0]!.toLowerCase()}${text.slice(1)}`;

// What the page itself knows.
function seen({ collisions, chips, strongest, wildest }: Facts): Judged {
  const places: Place[] = [];
  const [hit] = collisions;
  if (hit) {
    const more = collisions.length > 1 ? `, and ${collisions.length - 1} more` : "";
    places.push({ kind: "damage", words: `line ${hit.line}: ${hit.what}${more}`, line: hit.line, time: hit.time });
  }
  const chatters = wildest !== undefined && wildest.multiplier > 1;
  if (chatters) {
    const words = `line ${wildest.line}: chatters most, multiplier ${wildest.multiplier.toFixed(2)}`;
    places.push({ kind: "overload", words, line: wildest.line, time: wildest.time });
  }
  const thick = chips.filter(({ verdict }) => verdict === "overload").sort((a, b) => b.chip - a.chip);
  if (thick[0]) {
    const words = `line ${thick[0].line}: chip of ${thick[0].chip.toFixed(3)} mm; ${lines(thick.length)} overload a tooth`;
    places.push({ kind: "overload", words, line: thick[0].line, time: thick[0].time });
  }
  if (strongest) {
    const words = `line ${strongest.line}: highest load, ${strongest.peakForce.toFixed(0)} N`;
    places.push({ kind: "load", words, line: strongest.line, time: strongest.time });
  }
  const thin = chips.filter(({ verdict }) => verdict === "rubbing").sort((a, b) => a.chip - b.chip);
  if (thin[0]) {
    const words = `line ${thin[0].line}: the edge rubs, on ${lines(thin.length)}`;
    places.push({ kind: "rubbing", words, line: thin[0].line, time: thin[0].time });
  }
  let sentence = "Nothing is cut yet.";
  if (hit) sentence = "The tool hits what it must not.";
  else if (chatters) sentence = "The cut chatters.";
  else if (thick[0]) sentence = "Teeth are overloaded.";
  else if (strongest) sentence = "No collision, no overloaded tooth.";
  return { sentence, damage: hit !== undefined, places };
}

export function judge(facts: Facts): Judged {
  const { sentence, damage, places } = seen(facts);
  const soFar = (text: string) => (facts.strongest && !facts.whole ? `So far, ${small(text)}` : text);
  const { audit } = facts;
  if (!audit || !facts.strongest) return { sentence: soFar(sentence), damage, places: places.slice(0, MOST_PLACES) };
  // A stress that is over its limit for sure, at the low ends of both bands.
  const breaks = audit.tools.some(({ stress_n_per_mm2: stress }) => (stress?.ratio?.[0] ?? 0) > 1);
  const found = audit.verdict.findings.flatMap(({ outcome, text, line }): Place[] =>
    line === undefined ? [] : [{ kind: outcome === "over" ? "overload" : "load", words: text, line, time: undefined }],
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

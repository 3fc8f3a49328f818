// SPDX-License-Identifier: MIT
// The page of a comparison, filled as `tribo compare` fills it (src/report/compare/compare_page.cpp), with its template,
// style and script.

import type { AuditOfMill, AuditTool, Load } from "@tribo/wasm/audit";
import type { Joined, Pair, Quantity, Stretch } from "@tribo/wasm/joined";
import type { Vec3 } from "@tribo/protocol/vec3";
import script from "../../../../src/report/page/compare.js?raw";
import style from "../../../../src/report/page/style.css?raw";
import template from "../../../../src/report/page/comparison.html?raw";
import { RATE, type Clip } from "../learn/clip.js";
import { precise } from "../texts/figures.js";
import { language, t, translate, word } from "../texts/texts.js";
import type { Compared, Told } from "./compare_worker.js";
import { REACH_MM } from "./surface.js";

const SHOWN_PLACES = 10;
const SIDES = ["a", "b"] as const;
// What the script of the page says.
const WORDS = [
  word("cuts nothing here"),
  word("line {line} at {time} s: {values}"),
  word("Play"),
  word("Pause"),
  word("B cuts deeper"),
  word("B leaves more"),
];
// What the module calls the quantities.
void [
  word("peak force across the axis"),
  word("mean force"),
  word("peak torque"),
  word("axial depth"),
  word("thickest chip"),
  word("feed"),
  word("spindle speed"),
  word("chatter multiplier"),
  word("tool load"),
  word("cutting time"),
  word("removed volume"),
];
const AXES = { line: word("time of A, s"), "removed volume": word("removed volume, mm³"), time: word("time, s") };
const STEPS = {
  "removed volume": word(
    "Both cuts are joined by removed volume, as their lines differ and both remove about the same. A step is {step} mm³.",
  ),
  time: word("Both cuts are joined by time, as their lines and what they remove differ. A step is {step} s."),
};

const escaped = (text: string) =>
  text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}

/** 16 bits, two channels. */
export function wav([left, right]: Clip, rate: number): Uint8Array {
  const bytes = 4 * left.length;
  const view = new DataView(new ArrayBuffer(44 + bytes));
  const put = (at: number, name: string) => new Uint8Array(view.buffer).set(new TextEncoder().encode(name), at);
  put(0, "RIFF");
  view.setUint32(4, 36 + bytes, true);
  put(8, "WAVEfmt ");
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true);
  view.setUint16(22, 2, true);
  view.setUint32(24, rate, true);
  view.setUint32(28, 4 * rate, true);
  view.setUint16(32, 4, true);
  view.setUint16(34, 16, true);
  put(36, "data");
  view.setUint32(40, bytes, true);
  left.forEach((_, n) =>
    [left, right].forEach((channel, k) =>
      view.setInt16(44 + 4 * n + 2 * k, Math.round(32767 * Math.min(Math.max(channel[n]!, -1), 1)), true),
    ),
  );
  return new Uint8Array(view.buffer);
}

interface Total {
  name: string;
  unit: string;
  value: (audit: AuditOfMill) => { value: number; line?: number } | undefined;
}
const sum = (of: (tool: AuditTool) => number) => (audit: AuditOfMill) => ({
  value: audit.tools.reduce((all, tool) => all + of(tool), 0),
});
const most = (load: Load) => (audit: AuditOfMill) => {
  const peaks = audit.tools.flatMap((tool) => tool[load] ?? []);
  return peaks.reduce<(typeof peaks)[number] | undefined>(
    (m, peak) => (m && m.value >= peak.value ? m : peak),
    undefined,
  );
};
// The load of any kind that is nearest to its limit.
function nearest(audit: AuditOfMill): { value: number; line?: number } | undefined {
  const [worst] = audit.worst;
  if (!worst) return undefined;
  const ratios = Object.values(worst).flatMap((peak) =>
    typeof peak === "object" && peak !== null && "ratio" in peak && peak.ratio ? [peak.ratio[1]] : [],
  );
  return ratios.length > 0 ? { value: Math.max(...ratios), line: worst.line } : undefined;
}
const TIME: Total = {
  name: word("time of the program"),
  unit: "s",
  value: ({ duration_s }) => ({ value: duration_s }),
};
const FORCE: Total = { name: word("peak force across the axis"), unit: "N", value: most("peak_force_n") };
const POWER: Total = { name: word("peak power"), unit: "W", value: most("power_w") };
const TOTALS: Total[] = [
  TIME,
  { name: word("cutting time"), unit: "s", value: ({ cutting_s }) => ({ value: cutting_s }) },
  { name: word("removed volume"), unit: "mm³", value: sum((tool) => tool.removed_mm3) },
  FORCE,
  { name: word("peak torque"), unit: "N m", value: most("peak_torque_nm") },
  POWER,
  { name: word("thickest chip"), unit: "mm", value: most("chip_mm") },
  { name: word("chatter, |mu|"), unit: "", value: most("multiplier") },
  { name: word("tool load, to its limit"), unit: "", value: nearest },
  { name: word("collisions"), unit: "", value: ({ collisions }) => ({ value: collisions.length }) },
];

const digits = (value: number) => precise(value, 3);
const signed = (value: number) => `${value > 0 ? "+" : ""}${digits(value)}`;
const placed = (p: Vec3) => `${p.map((v) => digits(v)).join(language === "de" ? "; " : ", ")} mm`;

function verdict({ a, b, extremes }: Compared): string {
  const changes = [TIME, FORCE, POWER].flatMap(({ name, unit, value }) => {
    const [of, to] = [value(a.audit)?.value, value(b.audit)?.value];
    if (of === undefined || to === undefined || of === to) return [];
    const said = t("{what} {b} in place of {a} {unit}", { what: t(name), a: digits(of), b: digits(to), unit });
    return [of > 0 ? `${said} (${signed((100 * (to - of)) / of)} %)` : said];
  });
  const first = changes.length > 0 ? `B: ${changes.join(", ")}.` : t("Time, peak force and peak power do not differ.");
  const apart = Math.max(extremes.more?.mm ?? 0, -(extremes.less?.mm ?? 0));
  const parts =
    apart >= REACH_MM
      ? t("The parts are over {far} mm apart.", { far: digits(REACH_MM) })
      : apart > 0
        ? t("The parts are up to {far} mm apart.", { far: digits(apart) })
        : t("The parts are the same.");
  return `${first} ${parts}`;
}

function partFacts({ only, extremes: { more, less } }: Compared): string[] {
  const held =
    only.a === 0 && only.b === 0
      ? t("Both parts hold the same material.")
      : t("Only A holds {a} mm³, only B holds {b} mm³.", { a: digits(only.a), b: digits(only.b) });
  if (!more && !less) return [held, t("Their surfaces are the same.")];
  const facts = [held];
  const size = (mm: number) => (mm >= REACH_MM ? t("over {far}", { far: digits(REACH_MM) }) : digits(mm));
  if (more) facts.push(t("B leaves {mm} mm more at most, at {place}.", { mm: size(more.mm), place: placed(more.at) }));
  if (less) facts.push(t("B cuts {mm} mm deeper at most, at {place}.", { mm: size(-less.mm), place: placed(less.at) }));
  return facts;
}

const list = (facts: readonly string[]) =>
  facts.length > 0 ? `<ul class="facts">${facts.map((fact) => `<li>${escaped(fact)}</li>`).join("")}</ul>` : "";
const notice = (title: string, facts: readonly string[]) =>
  facts.length > 0 ? `<div class="notice"><b>${escaped(title)}</b>${list(facts)}</div>` : "";

function setUp({ a, b }: Compared): string[] {
  const differs: string[] = [];
  if (JSON.stringify(a.job.blank) !== JSON.stringify(b.job.blank)) differs.push(t("The stock, or its frame, differs."));
  if (JSON.stringify(a.job.cutters) !== JSON.stringify(b.job.cutters)) differs.push(t("The cutters differ."));
  if (a.path !== b.path) differs.push(t("The paths of the moves differ."));
  if (a.material !== b.material) differs.push(t("The materials differ."));
  return differs;
}

function table(title: string, head: string[], rows: string[][], kind = ""): string {
  const headed = head.map((text) => (text ? `<th scope="col">${escaped(text)}</th>` : "<td></td>")).join("");
  const body = rows.map(
    ([first, ...rest]) =>
      `<tr><th scope="row">${escaped(first!)}</th>${rest.map((cell) => `<td>${escaped(cell)}</td>`).join("")}</tr>`,
  );
  // It scrolls where it is wider than the window.
  return `<div class="wide" tabindex="0" role="region" aria-label="${escaped(title)}"><table class="${kind}"><tr>${headed}</tr>${body.join("")}</table></div>`;
}

function totals({ a, b }: Compared): string {
  const rows = TOTALS.flatMap(({ name, unit, value }) => {
    const [of, to] = [value(a.audit), value(b.audit)];
    if (!of && !to) return [];
    const cell = (v: typeof of) =>
      v ? `${digits(v.value)}${v.line ? ` (${t("line {line}", { line: v.line })})` : ""}` : t("not known");
    const change = of && to ? to.value - of.value : 0;
    const percent = of && of.value !== 0 && change !== 0 ? `${signed((100 * change) / Math.abs(of.value))} %` : "";
    return [[unit ? `${t(name)}, ${unit}` : t(name), cell(of), cell(to), of && to ? signed(change) : "", percent]];
  });
  return table(t("What changed"), ["", "A", "B", "B − A", ""], rows, "totals");
}

// Place and width on the common axis: by line the time of A.
const at = ({ by }: Joined, { place, a }: Pair) => (by === "line" ? a!.from_s : place);
const width = ({ by, step }: Joined, { a }: Pair) => (by === "line" ? a!.to_s - a!.from_s : step);

/** Those whose first quantity, the peak force, differs most, the largest difference first. */
export function largest({ pairs }: Joined, count: number): (Pair & { a: Stretch; b: Stretch })[] {
  const change = ({ a, b }: { a: Stretch; b: Stretch }) => Math.abs(b.values[0]! - a.values[0]!);
  return pairs
    .filter((pair): pair is Pair & { a: Stretch; b: Stretch } => pair.a !== undefined && pair.b !== undefined)
    .filter((pair) => change(pair) > 0)
    .sort((one, other) => change(other) - change(one))
    .slice(0, count);
}

function places(joined: Joined): string {
  const rows = largest(joined, SHOWN_PLACES).map(({ place, a, b }) => [
    joined.by === "line" ? t("line {line}", { line: place }) : `${digits(place)} ${joined.by === "time" ? "s" : "mm³"}`,
    String(a.line),
    String(b.line),
    digits(a.values[0]!),
    digits(b.values[0]!),
    digits(b.values[0]! - a.values[0]!),
    placed(b.tip),
  ]);
  if (rows.length === 0) return "";
  const head = [t("Place"), t("Line of A"), t("Line of B"), "A", "B", "B − A", t("Tip in B, mm")];
  return `<section><h2>${t("Where the force changes most")}</h2><p class="hint">${t("Peak force across the axis, N.")}</p>${table(t("Where the force changes most"), head, rows)}</section>`;
}

const view = (side: "a" | "b", name: string) =>
  `<figure class="part" id="view-${side}"><h3><span class="letter">${side.toUpperCase()}</span> ${escaped(name)}</h3>` +
  `<img alt="" hidden><div class="live" hidden><canvas tabindex="0" role="application" ` +
  `aria-roledescription="${t("3D view")}" aria-label="${t("Part {side}", { side: side.toUpperCase() })}" aria-describedby="view-hint"></canvas></div>` +
  `<p class="readout"></p></figure>`;

function listen({ a, b }: Compared): string {
  const values = { a: digits(a.heard_from_s), b: digits(b.heard_from_s) };
  const choices = SIDES.map(
    (side, n) =>
      `<label><input type="radio" name="heard" value="${side}"${n === 0 ? " checked" : ""}> ${side.toUpperCase()}</label>`,
  );
  return (
    `<section id="listen"><h2>${t("Sound")}</h2><p class="hint">` +
    t(
      "Both sounds run at the same time from the beginning of their cuts (A from {a} s, B from {b} s on); the switch changes which one you hear, without a gap.",
      values,
    ) +
    `</p><div class="buttons"><button type="button" id="play-sound">${t("Play")}</button>` +
    `<div class="choices" role="radiogroup" aria-label="${t("Hear")}">${choices.join("")}</div></div></section>`
  );
}

const unitOf = ({ unit }: Quantity) => t(unit.replace("mm3", "mm³"));

// Few digits, for plots; NaN is not known.
const few = (value: number, count: number) => (Number.isFinite(value) ? Number(value.toPrecision(count)) : null);

// Numbers of the quantities that at least one of the runs knows.
const known = ({ quantities, pairs }: Joined) =>
  quantities.map((_, n) => n).filter((n) => pairs.some(({ a, b }) => Boolean(a?.values[n] || b?.values[n])));

function dataOf(compared: Compared): string {
  const { joined } = compared;
  const lanes = known(joined);
  const side = (name: "a" | "b") => {
    const column = (of: (stretch: Stretch) => number | null) =>
      joined.pairs.map((pair) => (pair[name] ? of(pair[name]) : null));
    return {
      t: column(({ from_s }) => few(from_s, 8)),
      line: column(({ line }) => line),
      x: column(({ tip }) => few(tip[0], 6)),
      y: column(({ tip }) => few(tip[1], 6)),
      z: column(({ tip }) => few(tip[2], 6)),
      values: lanes.map((n) => column(({ values }) => few(values[n]!, 5))),
      part: compared[name].seen.part,
    };
  };
  const data = {
    schema: "tribo.compare-page/1",
    axis: t(AXES[joined.by]),
    lanes: lanes.map((n) => ({ name: t(joined.quantities[n]!.name), unit: unitOf(joined.quantities[n]!) })),
    at: joined.pairs.map((pair) => few(at(joined, pair), 8)),
    width: joined.pairs.map((pair) => few(width(joined, pair), 5)),
    a: side("a"),
    b: side("b"),
    words: { ...Object.fromEntries(WORDS.map((text) => [text, t(text)])), ".": language === "de" ? "," : "." },
  };
  // In a script no tag may end it.
  return JSON.stringify(data).replaceAll("<", "\\u003c");
}

const bytesOf = (id: string, bytes: Uint8Array) => `<script type="text/plain" id="${id}">${base64(bytes)}</script>`;

export interface Named {
  name: string;
  /** What was changed on the bench. */
  changes: string[];
}

/**
 * As one file that opens offline. Without its script it is for a frame of this page, whose policy lets no script run that
 * stands in a text.
 */
export function comparisonPage(compared: Compared, names: { a: Named; b: Named }, withScript: boolean): string {
  const page = new DOMParser().parseFromString(template, "text/html");
  if (!withScript) {
    for (const out of page.querySelectorAll("meta[http-equiv], script:not([type])")) out.remove();
    // The landmarks are those of the page around it.
    for (const mark of page.querySelectorAll("header, main, footer")) {
      const plain = page.createElement("div");
      plain.append(...mark.childNodes);
      mark.replaceWith(plain);
    }
  }
  translate(page.documentElement);
  page.documentElement.lang = language;
  const { joined } = compared;
  const what = ({ material, job }: Told, { changes }: Named) =>
    escaped([material, t("cutters: {count}", { count: job.cutters.length }), ...changes].join(", "));
  const marks: Record<string, () => string> = {
    title: () => `${escaped(names.a.name)}, ${escaped(names.b.name)}`,
    style: () => style,
    what_a: () => what(compared.a, names.a),
    what_b: () => what(compared.b, names.b),
    name_a: () => escaped(names.a.name),
    name_b: () => escaped(names.b.name),
    verdict: () => escaped(verdict(compared)),
    notices: () => notice(t("Compared as they stand"), setUp(compared)),
    totals: () => totals(compared),
    views: () => view("a", names.a.name) + view("b", names.b.name),
    part_facts: () => list(partFacts(compared)),
    joined: () =>
      joined.by === "line"
        ? t("Both cuts are joined by line: both runs cut in the same lines, in the same order.")
        : t(STEPS[joined.by], { step: digits(joined.step) }),
    lanes: () =>
      known(joined)
        .map(
          (quantity, n) =>
            `<label><input type="radio" name="lane" value="${n}"${n === 0 ? " checked" : ""}> ${escaped(t(joined.quantities[quantity]!.name))}</label>`,
        )
        .join("\n"),
    sound: () => listen(compared),
    warnings: () => notice(t("Warnings"), [...new Set([...compared.a.warnings, ...compared.b.warnings])]),
    data: () => dataOf(compared),
    parts: () => SIDES.map((side) => bytesOf(`part-${side}`, compared[side].seen.bytes)).join(""),
    sounds: () => SIDES.map((side) => bytesOf(`sound-${side}`, wav(compared[side].clip, RATE))).join(""),
    script: () => script,
    footer: () => `Tribo ${escaped(compared.version)}. ${t("Units: mm, N, s.")}`,
    tables: () => places(joined),
  };
  const html = `<!doctype html>\n${page.documentElement.outerHTML}`;
  return html.replace(/\{\{(\w+)\}\}/g, (_, mark: string) => marks[mark]?.() ?? "");
}

// SPDX-License-Identifier: MIT
// The texts of the mill page as they are written: what t() and word() say in its scripts, and what stands in its HTML.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

const MILL = join(import.meta.dirname, "../mill");
// The mill page fills it too.
const COMPARISON = join(import.meta.dirname, "../../src/report/page/comparison.html");

function textsOfHtml(html: string): string[] {
  const body = html.replace(/<(head|script|style)[ >][^]*?<\/\1>/g, "").replace(/<!--[^]*?-->/g, "");
  const attributes = [...body.matchAll(/\s(?:title|aria-label|placeholder)="([^"]*)"/g)].map(([, text]) => text!);
  const texts = body.replace(/<[^>]*>/g, "\n\0\n").split("\0");
  return [...attributes, ...texts].map((text) => text.trim().replace(/\s+/g, " ")).filter((text) => text !== "");
}

function textsOfScript(script: string): string[] {
  const said = [...script.matchAll(/\b(?:t|word)\(\s*("(?:[^"\\]|\\.)*")/g)].map(
    ([, text]) => JSON.parse(text!) as string,
  );
  const windows = [...script.matchAll(/const WINDOW = `([^`]*)`/g)].flatMap(([, html]) => textsOfHtml(html!));
  return [...said, ...windows];
}

// Numbers with their units, signs and names of keys are the same in all languages.
const hasWord = (text: string) => /\p{L}{2}/u.test(text.replace(/\b(mm|cm)\b|³/g, ""));

/** The English texts, each once. */
export function textsOfMillPage(): Set<string> {
  const names = readdirSync(join(MILL, "src"), { recursive: true, encoding: "utf8" }).filter(
    (name) => name.endsWith(".ts") && !name.startsWith("texts/"),
  );
  const scripts = names.flatMap((name) => textsOfScript(readFileSync(join(MILL, "src", name), "utf8")));
  const page = textsOfHtml(readFileSync(join(MILL, "index.html"), "utf8"));
  const comparison = textsOfHtml(readFileSync(COMPARISON, "utf8")).filter((text) => !text.includes("{{"));
  return new Set([...scripts, ...page, ...comparison].filter(hasWord));
}

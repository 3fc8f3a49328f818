// SPDX-License-Identifier: MIT
// The words of the page in the language of the user. English stands in the code and in index.html, and is the key of the
// other tables (as in GNU gettext), which are loaded when they are needed. What an engine or the module says stays English.

import { recall, remember } from "../page.js";

export type Language = "en" | "de";
export type Table = Readonly<Record<string, string>>;

const LOADERS: Record<Exclude<Language, "en">, () => Promise<{ TABLE: Table }>> = {
  de: () => import("./de.js"),
};
const KEPT = "language";

/** What the address asks for (`?lang=de`), else what was chosen before, else what the browser prefers. */
export function languageOf(address: string, chosen: string, preferred: readonly string[]): Language {
  const asked = new URLSearchParams(address).get("lang");
  const wanted = [asked ?? "", chosen, ...preferred.map((tag) => tag.slice(0, 2).toLowerCase())];
  return wanted.find((name): name is Language => name === "en" || Object.hasOwn(LOADERS, name)) ?? "en";
}

// Tests in Node.js read modules of the page without a page.
export const language: Language =
  typeof location === "undefined" ? "en" : languageOf(location.search, recall(KEPT), navigator.languages);
let table: Table | undefined;

/** Before anything else of the page is said. Without its table the page is English. */
export async function loadTexts(): Promise<void> {
  if (language === "en") return;
  try {
    ({ TABLE: table } = await LOADERS[language]());
    document.documentElement.lang = language;
    translate(document.documentElement);
  } catch {
    table = undefined;
  }
}

/** In the language of the user. `{name}` in the text is the value of that name. */
export function t(text: string, values: Readonly<Record<string, string | number>> = {}): string {
  const words = table?.[text] ?? text;
  return words.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));
}

/** Marks a text that is said later, through t(). */
export const word = (text: string): string => text;

const ATTRIBUTES = ["title", "aria-label", "placeholder"];

/** Translates what stands in the elements as it was written. */
export function translate(root: Element): void {
  if (!table) return;
  const texts = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  for (let node = texts.nextNode(); node; node = texts.nextNode()) {
    const [, before, text, after] = /^(\s*)([^]*?)(\s*)$/.exec(node.nodeValue ?? "")!;
    if (text) node.nodeValue = before + t(text.replace(/\s+/g, " ")) + after;
  }
  for (const element of root.querySelectorAll(ATTRIBUTES.map((name) => `[${name}]`).join()))
    for (const name of ATTRIBUTES) {
      const text = element.getAttribute(name);
      if (text !== null) element.setAttribute(name, t(text));
    }
}

/** From the next start of the page on. */
export function chooseLanguage(wanted: string): void {
  remember(KEPT, wanted);
}

// SPDX-License-Identifier: MIT
// Reads and changes single values in the text of a job, and leaves all else as it is written.

/** A value that stands in one line. */
export interface Entry {
  table: string; // "cutter" of [[cutter]]
  nth: number; // of tables with this name, from 0
  key: string;
  raw: string; // as TOML
  line: number; // from 0
}

// The length of what stands before a comment, and how many brackets are open there. Strings may hold both.
function codeOf(text: string): { length: number; open: number } {
  let open = 0;
  let quote = "";
  for (let n = 0; n < text.length; ++n) {
    const c = text[n]!;
    if (quote) {
      if (c === "\\" && quote === '"') ++n;
      else if (c === quote) quote = "";
    } else if (c === '"' || c === "'") quote = c;
    else if (c === "#") return { length: n, open };
    else if (c === "[" || c === "{") ++open;
    else if (c === "]" || c === "}") --open;
  }
  return { length: text.length, open };
}

const HEADER = /^\s*\[\[?\s*([\w.-]+)\s*\]\]?\s*(#.*)?$/;
const VALUE = /^(\s*([\w-]+)\s*=\s*)(.*)$/;

export function entriesOf(text: string): Entry[] {
  const entries: Entry[] = [];
  const counts = new Map<string, number>();
  let table = "";
  let open = 0; // of a value over several lines
  text.split(/\r?\n/).forEach((line, n) => {
    if (open > 0) {
      open += codeOf(line).open;
      return;
    }
    const header = HEADER.exec(line);
    if (header) {
      table = header[1]!;
      counts.set(table, (counts.get(table) ?? -1) + 1);
      return;
    }
    const value = VALUE.exec(line);
    if (!value) return;
    const [, , key, rest] = value as unknown as [string, string, string, string];
    const code = codeOf(rest);
    open = code.open;
    if (open === 0)
      entries.push({ table, nth: counts.get(table) ?? 0, key, raw: rest.slice(0, code.length).trim(), line: n });
  });
  return entries;
}

/** With another value; the comment behind it stays. */
export function withValue(text: string, line: number, raw: string): string {
  const lines = text.split("\n");
  lines[line] = lines[line]!.replace(VALUE, (_, before: string, _key, rest: string) => {
    const { length } = codeOf(rest);
    const code = rest.slice(0, length).trimEnd();
    return before + raw + rest.slice(code.length);
  });
  return lines.join("\n");
}

export function withoutLine(text: string, line: number): string {
  return text
    .split("\n")
    .filter((_, n) => n !== line)
    .join("\n");
}

/** With a value of the first table of this name, which may have none of this key yet. */
export function withKey(text: string, table: string, key: string, raw: string): string {
  const entry = entriesOf(text).find((e) => e.table === table && e.key === key);
  if (entry) return withValue(text, entry.line, raw);
  const lines = text.split("\n");
  const at = lines.findIndex((line) => HEADER.exec(line)?.[1] === table);
  if (at >= 0) lines.splice(at + 1, 0, `${key} = ${raw}`);
  else lines.push(`[${table}]`, `${key} = ${raw}`, "");
  return lines.join("\n");
}

/** A string as TOML. */
export const quoted = (text: string): string => JSON.stringify(text);
/** The string of a raw value; undefined: it is none. */
export function unquoted(raw: string): string | undefined {
  if (/^'[^']*'$/.test(raw)) return raw.slice(1, -1);
  try {
    const value: unknown = JSON.parse(raw);
    return typeof value === "string" ? value : undefined;
  } catch {
    return undefined;
  }
}

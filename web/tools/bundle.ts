// SPDX-License-Identifier: MIT
// One TypeScript entry with all that it imports becomes one minified file.
import { readFile } from "node:fs/promises";
import { build, type Plugin } from "rolldown";

const TARGET = "es2022";

/** Shaders and style sheets lie in the source as text, with comments and indentation; the page needs neither. */
const shortTexts: Plugin = {
  name: "short-texts",
  load: {
    filter: { id: /(shader|shadow)\.ts$/ },
    async handler(path) {
      const source = await readFile(path, "utf8");
      return { moduleType: "ts", code: source.replace(/`[^`$]*`/g, shorten) };
    },
  },
};

function shorten(text: string): string {
  return text
    .replace(/\/\/.*|\/\*[^]*?\*\//g, "")
    .replace(/\s*\n\s*/g, "\n")
    .replace(/ *([{};,=*+<>?/()-]) */g, "$1")
    .replace(/([{};,])\n/g, "$1")
    .replace(/: /g, ":");
}

export interface Bundle {
  entry: string;
  file: string;
  /** Text before the code. */
  banner?: string;
  /** Imports that stay imports. */
  external?: string[];
}

export async function bundle({ entry, file, banner, external }: Bundle): Promise<void> {
  await build({
    input: entry,
    external,
    plugins: [shortTexts],
    transform: { target: TARGET },
    output: {
      file,
      format: "esm",
      banner,
      comments: false,
      minify: { compress: { target: TARGET }, mangle: { toplevel: true } },
    },
  });
}

// SPDX-License-Identifier: MIT
// One TypeScript entry with all that it imports becomes one minified file.
import { readFile } from "node:fs/promises";
import { build, type InputOptions, type Plugin } from "rolldown";
import { shortShader, shortStyle } from "./shorten.js";

const TARGET = "es2022";

/** What makes every bundle smaller: no getter does more than get, and constants are written where they are used. */
export const COMPACT = {
  treeshake: { propertyReadSideEffects: false, unknownGlobalSideEffects: false },
  optimization: { inlineConst: { mode: "all", pass: 3 } },
} satisfies InputOptions;

/** Texts of shaders and style sheets that stand in the source between backticks. */
const shortTexts: Plugin = {
  name: "short-texts",
  load: {
    filter: { id: /(shader|shadow)\.ts$/ },
    async handler(path) {
      const short = path.endsWith("shader.ts") ? shortShader : shortStyle;
      return { moduleType: "ts", code: (await readFile(path, "utf8")).replace(/`[^`$]*`/g, short) };
    },
  },
};

export interface Bundle {
  entry: string;
  file: string;
  /** Text before the code. */
  banner?: string;
  /** A classic script that leaves its exports there; otherwise a module. */
  global?: string;
  /** Imports that stay imports. */
  external?: string[];
  /** A classic script that takes them from there. */
  externalGlobal?: string;
}

export async function bundle({ entry, file, banner, global, external, externalGlobal }: Bundle): Promise<void> {
  const classic = global !== undefined || externalGlobal !== undefined;
  await build({
    ...COMPACT,
    input: entry,
    external,
    plugins: [shortTexts],
    transform: { target: TARGET },
    output: {
      file,
      format: classic ? "iife" : "esm",
      name: global,
      globals: () => externalGlobal ?? "",
      postBanner: banner,
      comments: false,
      minify: { compress: { target: TARGET }, mangle: { toplevel: !classic } },
    },
  });
}

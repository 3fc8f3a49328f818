// SPDX-License-Identifier: MIT
// Builds dist/: the registering module, the class alone, the worklet, types, and touch.wasm beside them.
// TRIBO_WASM_DIR says where touch.wasm is (build/wasm of the repository otherwise).
import { execFileSync } from "node:child_process";
import { copyFile, mkdir, readFile, rm } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = new URL(".", import.meta.url).pathname;
const wasm = process.env.TRIBO_WASM_DIR ?? `${here}../../build/wasm`;
const banner = "// Tribo, MIT licence";

await rm(`${here}dist`, { recursive: true, force: true });
await mkdir(`${here}dist`, { recursive: true });
/** Shaders and style sheets lie in the source as text, with comments and indentation; the page needs neither. */
const texts = {
  name: "texts",
  setup(builder) {
    builder.onLoad({ filter: /(shader|shadow)\.ts$/ }, async ({ path }) => ({
      loader: "ts",
      contents: (await readFile(path, "utf8")).replace(/`[^`$]*`/g, (text) =>
        text.replace(/\/\/.*|\/\*[^]*?\*\//g, "").replace(/\s*\n\s*/g, "\n").replace(/ *([{};,=*+<>?]) */g, "$1").replace(/: /g, ":")),
    }));
  },
};
const common = {
  bundle: true, format: "esm", target: "es2022", minify: true, legalComments: "none", banner: { js: banner },
  plugins: [texts],
};
await build({ ...common, entryPoints: { "tribo-touch": `${here}src/index.ts` }, outdir: `${here}dist` });
await build({ ...common, entryPoints: { element: `${here}src/element.ts`, worklet: `${here}src/worklet.ts` }, outdir: `${here}dist` });
await copyFile(`${wasm}/touch.wasm`, `${here}dist/touch.wasm`);
execFileSync(process.execPath, [`${here}../node_modules/typescript/bin/tsc`, "-p", `${here}tsconfig.json`], { stdio: "inherit" });

let total = 0;
for (const file of ["tribo-touch.js", "worklet.js", "touch.wasm"]) {
  const bytes = gzipSync(await readFile(`${here}dist/${file}`), { level: 9 }).length;
  total += bytes;
  console.log(`${file.padEnd(16)} ${bytes} bytes gzip`);
}
console.log(`${"together".padEnd(16)} ${total} bytes gzip`);
if (total > 39_500) throw new Error("the component has grown: 39.5 kB is the most that it may take");

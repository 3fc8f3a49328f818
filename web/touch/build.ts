// SPDX-License-Identifier: MIT
// Builds dist/: the registering module, the class alone, the worklet, types, and touch.wasm beside them.
import { execFileSync } from "node:child_process";
import { copyFile, mkdir, readdir, readFile, rm } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { bundle } from "../tools/bundle.js";
import { COMPONENT, MODULES } from "../tools/places.js";

/** What a page may have to fetch for the component, packed. */
const MOST_BYTES = 39_000;

/** Removes declarations that the entries do not import, directly or through others. */
async function keepReachable(folder: string, entries: string[]): Promise<void> {
  const reached = new Set(entries);
  for (const file of reached) {
    const text = await readFile(join(folder, file), "utf8");
    for (const [, from = ""] of text.matchAll(/from "(.*?)"/g)) {
      if (!from.startsWith("./")) throw new Error(`${file} imports ${from}, which a user of the package does not have`);
      reached.add(from.slice(2).replace(/\.js$/, ".d.ts"));
    }
  }
  for (const file of await readdir(folder)) if (!reached.has(file)) await rm(join(folder, file));
}

const here = import.meta.dirname;
const banner = "// Tribo, MIT";
const entries = { "tribo-touch": "index", element: "element", worklet: "worklet" };

await rm(COMPONENT, { recursive: true, force: true });
await mkdir(COMPONENT, { recursive: true });
for (const [name, entry] of Object.entries(entries)) {
  // The component fetches its worklet, and says the licence of both.
  const said = name === "worklet" ? undefined : banner;
  await bundle({ entry: join(here, `src/${entry}.ts`), file: join(COMPONENT, `${name}.js`), banner: said });
}
await copyFile(join(MODULES, "touch.wasm"), join(COMPONENT, "touch.wasm"));
const compiler = join(dirname(createRequire(import.meta.url).resolve("typescript/package.json")), "bin/tsc");
execFileSync(process.execPath, [compiler, "-p", here], { stdio: "inherit" });
await keepReachable(join(COMPONENT, "types"), ["index.d.ts", "element.d.ts"]);

let total = 0;
for (const file of ["tribo-touch.js", "worklet.js", "touch.wasm"]) {
  const bytes = gzipSync(await readFile(join(COMPONENT, file)), { level: 9 }).length;
  total += bytes;
  console.log(`${file.padEnd(16)} ${bytes} bytes gzip`);
}
console.log(`${"together".padEnd(16)} ${total} bytes gzip`);
if (total > MOST_BYTES) throw new Error(`the component has grown: ${MOST_BYTES} bytes are the most that it may take`);

// SPDX-License-Identifier: MIT
// Puts the static site together in build/web/site: the page, the built component, the materials of
// examples/materials with their images. `tribo site` copies it.
import { copyFile, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { existsSync } from "node:fs";
import { basename, join } from "node:path";
import { build } from "esbuild";

const here = new URL(".", import.meta.url).pathname, root = join(here, "../../..");
const out = process.env.TRIBO_SITE_DIR ?? join(root, "build/web/site"), examples = join(root, "examples/materials");

/** Material files of the examples, deepest folders last. */
async function materialFiles(folder) {
  if (!existsSync(folder)) return [];
  const found = [];
  for (const entry of (await readdir(folder, { withFileTypes: true })).sort((a, b) => (a.name < b.name ? -1 : 1))) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) found.push(...(await materialFiles(path)));
    else if (entry.name.endsWith(".json")) found.push(path);
  }
  return found;
}

await rm(out, { recursive: true, force: true });
await mkdir(join(out, "materials"), { recursive: true });
for (const file of ["index.html", "touch.css"]) await copyFile(join(here, file), join(out, file));
for (const file of ["tribo-touch.js", "worklet.js", "touch.wasm"]) await copyFile(join(here, "../dist", file), join(out, file));
const wasm = process.env.TRIBO_WASM_DIR ?? join(root, "build/wasm"), common = { bundle: true, format: "esm", target: "es2022", minify: true };
await copyFile(join(wasm, "learn.wasm"), join(out, "learn.wasm"));
// The component is the page's neighbour, not a part of it.
await build({ ...common, entryPoints: [join(here, "page.ts")], outdir: out, external: ["./make.js"], banner: { js: 'import "./tribo-touch.js";' } });
await build({ ...common, entryPoints: [join(here, "make.ts"), join(here, "learner.ts")], outdir: out });
const listed = [];
for (const path of await materialFiles(examples)) {
  const material = JSON.parse(await readFile(path, "utf8"));
  if (material.schema !== "tribo.material/1" || !material.image) continue;
  // Flat and by the material's name, so that no two meet.
  const name = basename(path, ".json"), image = `${name}-${basename(material.image)}`;
  await copyFile(join(path, "..", material.image), join(out, "materials", image));
  const map = material.height_map && `${name}-heights-${basename(material.height_map)}`;
  if (map) await copyFile(join(path, "..", material.height_map), join(out, "materials", map));
  await writeFile(join(out, "materials", `${name}.json`), JSON.stringify({ ...material, image, height_map: map }));
  listed.push({ file: `materials/${name}.json`, name: material.name || name, note: material.note ?? "", image: `materials/${image}` });
}
await writeFile(join(out, "materials.json"), JSON.stringify(listed));
const { version } = JSON.parse(await readFile(join(here, "../package.json"), "utf8"));
await writeFile(join(out, "site.json"), `${JSON.stringify({ schema: "tribo.site/1", version, materials: listed.length })}\n`);
console.log(`site with ${listed.length} materials`);

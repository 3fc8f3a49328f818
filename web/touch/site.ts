// SPDX-License-Identifier: MIT
// Puts the static site together in build/web/site: the page, the built component, the materials of
// examples/materials with their images. `tribo site` copies it.
import { existsSync } from "node:fs";
import { copyFile, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { bundle } from "../tools/bundle.js";
import { COMPONENT, MODULES, ROOT, SITE } from "../tools/places.js";
import { withPolicy } from "../tools/policy.js";
import { shortStyle } from "../tools/shorten.js";
import { version } from "./package.json";
import SAYS from "./site/sentences.json";
import { kSchema } from "./src/material_schema.js";

interface MaterialFile {
  schema: string;
  name?: string;
  note?: string;
  image?: string;
  height_map?: string;
}

const here = join(import.meta.dirname, "site");

/** Material files of the examples, deepest folders last. */
async function materialFiles(folder: string): Promise<string[]> {
  if (!existsSync(folder)) return [];
  const found: string[] = [];
  for (const entry of (await readdir(folder, { withFileTypes: true })).sort((a, b) => (a.name < b.name ? -1 : 1))) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) found.push(...(await materialFiles(path)));
    else if (entry.name.endsWith(".json")) found.push(path);
  }
  return found;
}

await rm(SITE, { recursive: true, force: true });
await mkdir(join(SITE, "materials"), { recursive: true });
await writeFile(join(SITE, "index.html"), withPolicy(await readFile(join(here, "index.html"), "utf8")));
await writeFile(join(SITE, "touch.css"), shortStyle(await readFile(join(here, "touch.css"), "utf8")));
for (const file of ["tribo-touch.js", "worklet.js", "touch.wasm"])
  await copyFile(join(COMPONENT, file), join(SITE, file));
await copyFile(join(MODULES, "learn.wasm"), join(SITE, "learn.wasm"));
// The component is the page's neighbour, not a part of it; what makes a material comes when it is asked for.
await bundle({
  entry: join(here, "page.ts"),
  file: join(SITE, "page.js"),
  external: ["./make.js"],
  banner: 'import "./tribo-touch.js";',
});
for (const name of ["make", "learner"])
  await bundle({ entry: join(here, `${name}.ts`), file: join(SITE, `${name}.js`) });

const listed: { file: string; name: string; note: string; says?: string; image: string }[] = [];
for (const path of await materialFiles(join(ROOT, "examples/materials"))) {
  const material = JSON.parse(await readFile(path, "utf8")) as MaterialFile;
  if (material.schema !== kSchema || !material.image) continue;
  // Flat and by the material's name, so that no two meet.
  const name = basename(path, ".json");
  const image = `${name}-${basename(material.image)}`;
  const map = material.height_map && `${name}-heights-${basename(material.height_map)}`;
  await copyFile(join(path, "..", material.image), join(SITE, "materials", image));
  if (material.height_map && map) await copyFile(join(path, "..", material.height_map), join(SITE, "materials", map));
  await writeFile(join(SITE, "materials", `${name}.json`), JSON.stringify({ ...material, image, height_map: map }));
  listed.push({
    file: `materials/${name}.json`,
    name: material.name || name,
    note: material.note ?? "",
    says: (SAYS as Record<string, string | undefined>)[name],
    image: `materials/${image}`,
  });
}
await writeFile(join(SITE, "materials.json"), JSON.stringify(listed));
await writeFile(
  join(SITE, "site.json"),
  `${JSON.stringify({ schema: "tribo.site/1", version, materials: listed.length })}\n`,
);
console.log(`site with ${listed.length} materials`);

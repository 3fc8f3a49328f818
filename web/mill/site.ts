// SPDX-License-Identifier: MIT
// Puts the mill page without an engine, and its examples, into the static site (build/web/site/mill).
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { MILL_PAGE, ROOT, SITE } from "../tools/places.js";
import { withPolicy } from "../tools/policy.js";

// The first is milled when the page opens.
const EXAMPLES = [
  { name: "Bowl", job: "bowl.toml", folder: "bowl", files: ["bowl.toml", "bowl.csv", "bowl.wrl"] },
  { name: "Plate", job: "plate.toml", folder: "plate", files: ["plate.toml", "plate.nc"] },
  { name: "Pocket", job: "pocket.toml", folder: "pocket", files: ["pocket.toml", "pocket.nc"] },
  { name: "Howl", job: "howl.toml", folder: "howl", files: ["howl.toml", "slot.nc"] },
  { name: "Dome", job: "dome.toml", folder: "dome", files: ["dome.toml", "dome.nc"] },
  { name: "Bracket", job: "bracket.toml", folder: "bracket", files: ["bracket.toml", "bracket.nc"] },
  { name: "Blade", job: "blade.toml", folder: "blade", files: ["blade.toml", "blade.apt", "blade.wrl", "blank.wrl"] },
];

const out = join(SITE, "mill");
rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, "examples"), { recursive: true });
for (const name of readdirSync(MILL_PAGE)) {
  if (/\.(br|gz)$/.test(name)) continue;
  copyFileSync(join(MILL_PAGE, name), join(out, name));
}
const page = readFileSync(join(out, "index.html"), "utf8");
const none = page.replace('name="tribo-engine" content="here"', 'name="tribo-engine" content="none"');
if (none === page) throw new Error("the page does not say who mills");
writeFileSync(join(out, "index.html"), withPolicy(none));
for (const { folder, files } of EXAMPLES) {
  for (const file of files) copyFileSync(join(ROOT, "examples", folder, file), join(out, "examples", file));
}
writeFileSync(
  join(out, "examples/examples.json"),
  JSON.stringify(EXAMPLES.map(({ name, job, files }) => ({ name, job, files }))),
);
console.log(`mill page with ${EXAMPLES.length} examples`);

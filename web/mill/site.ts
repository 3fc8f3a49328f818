// SPDX-License-Identifier: MIT
// Puts the mill page without an engine into the static site (build/web/site/mill).
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { MILL_PAGE, SITE } from "../tools/places.js";
import { withPolicy } from "../tools/policy.js";

const out = join(SITE, "mill");
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
for (const name of readdirSync(MILL_PAGE)) {
  if (/\.(br|gz)$/.test(name)) continue;
  copyFileSync(join(MILL_PAGE, name), join(out, name));
}
const page = readFileSync(join(out, "index.html"), "utf8");
const none = page.replace('name="tribo-engine" content="here"', 'name="tribo-engine" content="none"');
// Where motion is not wanted there is no film, and no picture before it.
const poster = `<picture id="poster" hidden><source media="(prefers-reduced-motion: reduce)" srcset="data:," /><img alt=""
 src="./poster.webp" fetchpriority="high" elementtiming="poster" /></picture>`;
const framed = none.replace('<picture id="poster" hidden></picture>', poster);
if (framed === none) throw new Error("the page has no place for its first picture");
if (none === page) throw new Error("the page does not say who mills");
writeFileSync(join(out, "index.html"), withPolicy(framed));

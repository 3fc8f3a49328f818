// SPDX-License-Identifier: MIT
// The page's scripts as the program embeds them. They are kept in the repository, so that the program builds without Node.js.
import { join } from "node:path";
import { bundle } from "../tools/bundle.js";
import { ROOT } from "../tools/places.js";

export const KEPT = join(ROOT, "src/report/page");
export const SCRIPTS = ["script.js", "view.js", "compare.js"];

const GLOBAL = "report";
const banner = "// Made of web/report by npm run write. Tribo, MIT licence.";
const source = (name: string) => join(import.meta.dirname, "src", name);

export async function bundleReport(folder: string): Promise<void> {
  await bundle({ entry: source("main.ts"), file: join(folder, "script.js"), banner, global: GLOBAL });
  await bundle({
    entry: source("part_view.ts"),
    file: join(folder, "view.js"),
    banner,
    external: ["./shared.js", "./state.js"],
    externalGlobal: GLOBAL,
  });
  await bundle({ entry: source("compare.ts"), file: join(folder, "compare.js"), banner, global: "comparison" });
}

// SPDX-License-Identifier: MIT
// Licences of what the mill page is made of, as one text that the page links to.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { ROOT } from "../tools/places.js";

const PACKAGES = ["three", "uplot"];
/** Linked into the modules. Systems that have these packages keep the texts there. */
const SYSTEM_PACKAGES = ["wasi-libc", "libc++-19-dev-wasm32", "libtomlplusplus-dev"];

export function notices(): string {
  const modules = join(ROOT, "web/node_modules");
  const parts = [
    ["Tribo", join(ROOT, "LICENSE")],
    ["What Tribo rests on", join(ROOT, "NOTICE")],
    ...PACKAGES.map((name) => [name, join(modules, name, "LICENSE")] as const),
    ...SYSTEM_PACKAGES.map((name) => [name, join("/usr/share/doc", name, "copyright")] as const).filter(([, path]) =>
      existsSync(path),
    ),
  ] as const;
  return parts
    .map(([title, path]) => `${title}\n${"=".repeat(title.length)}\n\n${readFileSync(path, "utf8")}`)
    .join("\n\n");
}

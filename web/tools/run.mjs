// SPDX-License-Identifier: MIT
// node run.mjs SCRIPT.ts [argument...]: runs a TypeScript script; Node.js 20 does not by itself.
import { resolve } from "node:path";
import { runnerImport } from "vite";

const [script] = process.argv.splice(2, 1);
if (script === undefined) throw new Error("no script is named: node run.mjs SCRIPT.ts");
await runnerImport(resolve(script));

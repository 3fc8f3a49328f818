// SPDX-License-Identifier: MIT
// The bits that the native builds agree on (tests/golden/golden.txt), by WebAssembly in Node.js.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { ROOT } from "../../tools/places.js";
import type { CommonExports, GoldenExports } from "../src/exports.js";
import { textAt } from "../src/memory.js";
import { load } from "./load.js";

const lines = readFileSync(join(ROOT, "tests/golden/golden.txt"), "utf8").trim().split("\n");
const agreed = lines.map((line) => line.split(" ") as [string, string]);

test("tribo.wasm says its version and gives aligned memory", async () => {
  const x = await load<CommonExports>("tribo");
  const [, version] = /project\(tribo VERSION (\S+)/.exec(readFileSync(join(ROOT, "CMakeLists.txt"), "utf8")) ?? [];
  expect(textAt(x, x.tribo_version())).toBe(version);
  const at = x.tribo_allocate(1000);
  expect(at % 16).toBe(0);
  x.tribo_release(at);
});

test.each(agreed)("golden.wasm computes the bits of %s that native builds compute", async (name, hash) => {
  const x = await load<GoldenExports>("golden");
  expect(x.golden_count()).toBe(agreed.length);
  const index = Array.from({ length: x.golden_count() }, (_, i) => textAt(x, x.golden_name(i))).indexOf(name);
  expect(BigInt.asUintN(64, x.golden_hash(index)).toString(16).padStart(16, "0")).toBe(hash);
});

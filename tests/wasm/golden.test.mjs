// SPDX-License-Identifier: MIT
// The WebAssembly modules in Node: no imports, and the bits that the native builds agree on (tests/golden/golden.txt).
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

const folder = process.env.TRIBO_WASM_DIR ?? new URL("../../build/wasm", import.meta.url).pathname;

async function load(name) {
  const module = await WebAssembly.compile(await readFile(`${folder}/${name}.wasm`));
  assert.deepEqual(WebAssembly.Module.imports(module), [], `${name}.wasm imports something`);
  const { exports } = await WebAssembly.instantiate(module, {});
  exports._initialize?.();
  return exports;
}

function text(exports, pointer) {
  const bytes = new Uint8Array(exports.memory.buffer, pointer);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

test("tribo.wasm needs nothing from outside and says its version", async () => {
  const tribo = await load("tribo");
  const cmake = await readFile(new URL("../../CMakeLists.txt", import.meta.url), "utf8");
  assert.equal(text(tribo, tribo.tribo_version()), /project\(tribo VERSION (\S+)/.exec(cmake)[1]);
  const memory = tribo.tribo_allocate(1000);
  assert.equal(memory % 16, 0);
  tribo.tribo_release(memory);
});

test("golden.wasm computes the bits that native builds compute", async (t) => {
  const golden = await load("golden");
  const lines = (await readFile(new URL("../golden/golden.txt", import.meta.url), "utf8")).trim().split("\n");
  const agreed = new Map(lines.map((line) => line.split(" ")));
  assert.equal(golden.golden_count(), agreed.size);
  for (let i = 0; i < golden.golden_count(); ++i) {
    const name = text(golden, golden.golden_name(i));
    await t.test(name, () => {
      const hash = BigInt.asUintN(64, golden.golden_hash(i)).toString(16).padStart(16, "0");
      assert.equal(hash, agreed.get(name));
    });
  }
});

// SPDX-License-Identifier: MIT
// The bits that native builds and Node agree on (tests/golden/golden.txt), in Chromium.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { expect, test } from "vitest";
import { hasBrowser, launch } from "../../testing/browser.js";
import { MODULES, ROOT } from "../../tools/places.js";
import { serve } from "./site.js";

const wasm = join(MODULES, "golden.wasm");

test.skipIf(!hasBrowser || !existsSync(wasm))("Chromium computes the elastic image to the same bits", async () => {
  const [, agreed] = /^elastic (\S+)$/m.exec(await readFile(join(ROOT, "tests/golden/golden.txt"), "utf8")) ?? [];
  const site = await serve();
  site.pages.set("/golden.wasm", await readFile(wasm));
  site.page("/", "");
  const browser = await launch();
  try {
    const page = await browser.newPage();
    await page.goto(`${site.root}/`);
    const hash = await page.evaluate(async () => {
      const { instance } = await WebAssembly.instantiate(await (await fetch("golden.wasm")).arrayBuffer(), {});
      const x = instance.exports as unknown as {
        memory: WebAssembly.Memory;
        _initialize(): void;
        golden_count(): number;
        golden_name(n: number): number;
        golden_hash(n: number): bigint;
      };
      x._initialize();
      const name = (i: number) => {
        const bytes = new Uint8Array(x.memory.buffer, x.golden_name(i));
        return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
      };
      for (let i = 0; i < x.golden_count(); ++i) {
        if (name(i) === "elastic") return BigInt.asUintN(64, x.golden_hash(i)).toString(16).padStart(16, "0");
      }
      return "";
    });
    expect(hash).toBe(agreed);
  } finally {
    await browser.close();
    await site.close();
  }
});

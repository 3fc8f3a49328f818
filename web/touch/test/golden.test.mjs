// SPDX-License-Identifier: MIT
// The bits that native builds and Node agree on (tests/golden/golden.txt), in Chromium.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { expect, test } from "vitest";
import { hasBrowser, launch } from "./browser.mjs";
import { serve } from "./site.mjs";

const wasm = `${process.env.TRIBO_WASM_DIR ?? new URL("../../../build/wasm", import.meta.url).pathname}/golden.wasm`;

test.skipIf(!hasBrowser || !existsSync(wasm))("Chromium computes the elastic image to the same bits", async () => {
  const agreed = /^elastic (\S+)$/m.exec(await readFile(new URL("../../../tests/golden/golden.txt", import.meta.url), "utf8"))[1];
  const site = await serve();
  site.pages.set("/golden.wasm", await readFile(wasm));
  site.page("/", "");
  const browser = await launch();
  try {
    const page = await browser.newPage();
    await page.goto(`${site.root}/`);
    const hash = await page.evaluate(async () => {
      const { instance } = await WebAssembly.instantiate(await (await fetch("golden.wasm")).arrayBuffer(), {});
      const x = instance.exports;
      x._initialize();
      const name = (i) => {
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

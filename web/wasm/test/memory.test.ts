// SPDX-License-Identifier: MIT
import { expect, test } from "vitest";
import type { TouchExports } from "../src/exports.js";
import { bytesAt, doublesAt, lend, lendText, textAt } from "../src/memory.js";
import { load } from "./load.js";

test("what is lent lies in the module as long as it is used", async () => {
  const x = await load<TouchExports>("touch");
  const numbers = new Float64Array([7, 1, 2, 3]).subarray(1);
  expect(lend(x, numbers, (at, bytes) => [bytes, ...doublesAt(x, at, 3)])).toEqual([24, 1, 2, 3]);
  expect(lendText(x, "Ångström\0", (at, bytes) => [bytes, textAt(x, at)])).toEqual([11, "Ångström"]);
  // The same place again and again: it was given back.
  const places = new Set(Array.from({ length: 100 }, () => lend(x, numbers, (at) => at)));
  expect(places.size).toBe(1);
});

test("memory that grows while something is lent is seen as it is then", async () => {
  const x = await load<TouchExports>("touch");
  const before = x.memory.buffer.byteLength;
  const kept = lend(x, new Uint8Array([1, 2, 3]), (at) => {
    while (x.memory.buffer.byteLength === before) x.sheet_create(512, 512, 1);
    return [...bytesAt(x, at, 3)];
  });
  expect(kept).toEqual([1, 2, 3]);
});

// SPDX-License-Identifier: MIT
// golden_speed.mjs FOLDER NAME...: milliseconds that golden.wasm of that folder takes for each golden line, the median of
// several runs in one instance.
import { readFile } from "node:fs/promises";

const [folder, ...names] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(await readFile(`${folder}/golden.wasm`), {});
const golden = instance.exports;
golden._initialize?.();

function name(which) {
  const bytes = new Uint8Array(golden.memory.buffer, golden.golden_name(which));
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

for (let which = 0; which < golden.golden_count(); ++which) {
  if (!names.includes(name(which))) continue;
  const times = [];
  for (let n = 0; n < 9; ++n) {
    const start = performance.now();
    golden.golden_hash(which);
    times.push(performance.now() - start);
  }
  times.sort((a, b) => a - b);
  console.log(name(which), times[times.length >> 1]);
}

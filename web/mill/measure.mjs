// SPDX-License-Identifier: MIT
// node measure.mjs [JOB]: what a visitor of `tribo live` waits for, in headless Chromium, as JSON: until the first picture (the blank)
// and until the part's own surface is on the screen. At 1.6 Mbit/s and 150 ms with a processor four times slower, and without all that.
// Medians of TRIBO_RUNS (5) runs. docs/mill-page.md has the numbers.
import { spawn } from "node:child_process";
import { join } from "node:path";
import { launch } from "../touch/test/browser.mjs";

const ROOT = join(import.meta.dirname, "../.."), RUNS = Number(process.env.TRIBO_RUNS ?? 5);
// More corners than the blank's box and the tool have.
const PART_CORNERS = 1000;

const job = process.argv[2] ?? join(ROOT, "examples/bowl/bowl.toml");
const engine = spawn(join(ROOT, "build/release/tribo"), ["live", job, "--port", "0", "--audio", "off"]);
let said = "";
engine.stdout.on("data", (text) => (said += text));
engine.stderr.on("data", (text) => (said += text));
const address = () => said.match(/https?:\/\/\S+/)?.[0];
while (address() === undefined && engine.exitCode === null) await new Promise((done) => setTimeout(done, 50));
if (engine.exitCode !== null) throw new Error(said);

/** In the page: notes when what was drawn is on the screen. */
function watch(partCorners) {
  window.seen = {};
  const note = (what) => {
    if (what in window.seen) return;
    window.seen[what] = 0;
    requestAnimationFrame(() => setTimeout(() => (window.seen[what] = performance.now())));
  };
  const plain = WebGL2RenderingContext.prototype.drawElements;
  WebGL2RenderingContext.prototype.drawElements = function (mode, count, ...rest) {
    note("first");
    if (count > partCorners) note("part");
    return plain.call(this, mode, count, ...rest);
  };
}

async function visit(throttled) {
  const browser = await launch();
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
  await page.addInitScript(watch, PART_CORNERS);
  if (throttled) {
    const cdp = await page.context().newCDPSession(page);
    await cdp.send("Network.enable");
    await cdp.send("Network.emulateNetworkConditions", { offline: false, latency: 150, downloadThroughput: 1.6e6 / 8, uploadThroughput: 0.75e6 / 8 });
    await cdp.send("Emulation.setCPUThrottlingRate", { rate: 4 });
  }
  // A visitor's browser is up already.
  await page.waitForTimeout(1500);
  await page.goto(address(), { waitUntil: "commit" });
  await page.waitForFunction(() => window.seen.part > 0, null, { polling: 50 });
  const seen = await page.evaluate(() => window.seen);
  await browser.close();
  return seen;
}

const median = (values) => Math.round([...values].sort((a, b) => a - b)[values.length >> 1]);
const measured = {};
for (const [name, throttled] of [["throttled", true], ["unthrottled", false]]) {
  const visits = [];
  for (let n = 0; n < RUNS; ++n) visits.push(await visit(throttled));
  measured[`first_picture_${name}_ms`] = median(visits.map((seen) => seen.first));
  measured[`part_${name}_ms`] = median(visits.map((seen) => seen.part));
}
console.log(JSON.stringify(measured));
engine.kill();

// SPDX-License-Identifier: MIT
// npm run measure [JOB]: what a visitor of `tribo live` waits for, in headless Chromium, as JSON: until the first picture (the blank)
// and until the part's own surface is on the screen. At 1.6 Mbit/s and 150 ms with a processor four times slower, and without all that.
// Medians of TRIBO_RUNS (5) runs. The same of the static page's first visit, until the picture that stands for the part is on the
// screen. Then the gaps in the sound of the static page, alone and beside two busy processes.
// docs/mill-page.md has the numbers.
import { join } from "node:path";
import { launch, slowDown } from "../testing/browser.js";
import { startLive } from "../testing/live.js";
import { serveFolder } from "../testing/server.js";
import { soundGaps, type Gaps } from "./sound_gaps.js";
import { ROOT, SITE } from "../tools/places.js";

/** What was drawn, and when it was on the screen, ms. */
type Seen = Partial<Record<"first" | "part" | "poster", number>>;
declare global {
  interface Window {
    seen: Seen;
  }
}

const RUNS = Number(process.env.TRIBO_RUNS ?? 5);
// More corners than the blank's box and the tool have.
const PART_CORNERS = 1000;

const job = process.argv[2] ?? join(ROOT, "examples/bowl/bowl.toml");
const { engine, url } = await startLive(job, "--port", "0", "--audio", "off");

/** In the page: notes when what was drawn is on the screen. */
function watch(partCorners: number): void {
  window.seen = {};
  const note = (what: keyof Seen) => {
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

/** In the static page. */
function watchPoster(): void {
  window.seen = {};
  new PerformanceObserver((list) => {
    const [shown] = list.getEntries() as (PerformanceEntry & { renderTime: number })[];
    if (shown) window.seen.poster = shown.renderTime;
  }).observe({ type: "element", buffered: true });
}

async function visit(
  throttled: boolean,
  [address, script, until]: [string, (corners: number) => void, keyof Seen] = [url, watch, "part"],
): Promise<Seen> {
  const browser = await launch();
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
  await page.addInitScript(script, PART_CORNERS);
  if (throttled) await slowDown(page);
  // A visitor's browser is up already.
  await page.waitForTimeout(1500);
  await page.goto(address, { waitUntil: "commit" });
  await page.waitForFunction((what) => (window.seen[what] ?? 0) > 0, until, { polling: 50 });
  const seen = await page.evaluate(() => window.seen);
  await browser.close();
  return seen;
}

const median = (values: number[]) => Math.round(values.sort((a, b) => a - b)[values.length >> 1]!);
const measured: Record<string, number> = {};
for (const [name, throttled] of [
  ["throttled", true],
  ["unthrottled", false],
] as const) {
  const visits: Required<Seen>[] = [];
  for (let n = 0; n < RUNS; ++n) visits.push((await visit(throttled)) as Required<Seen>);
  measured[`first_picture_${name}_ms`] = median(visits.map((seen) => seen.first));
  measured[`part_${name}_ms`] = median(visits.map((seen) => seen.part));
}
engine.kill();
const site = await serveFolder(SITE);
const posters: number[] = [];
for (let n = 0; n < RUNS; ++n) posters.push((await visit(true, [`${site.root}/mill/`, watchPoster, "poster"])).poster!);
measured.first_picture_static_throttled_ms = median(posters);
await site.close();
for (const [name, busy] of [
  ["alone", 0],
  ["beside_two", 2],
] as const) {
  const runs: Gaps[] = [];
  for (let n = 0; n < RUNS; ++n) runs.push(await soundGaps(busy));
  measured[`sound_late_${name}_ms`] = Math.max(...runs.map((run) => run.late_ms));
  measured[`sound_silent_${name}_ms`] = Math.max(...runs.map((run) => run.silent_ms));
}
console.log(JSON.stringify(measured));

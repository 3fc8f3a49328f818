// SPDX-License-Identifier: MIT
// node measure.mjs: what a visitor waits for, in headless Chromium against the built site, as JSON. First touchable frame of the
// five-line page at 1.6 Mbit/s and 150 ms with a processor four times slower; main-thread work of a frame of a whole 512 x 512
// sheet, and what of it is the engine's; gesture to first sample, cold. Medians of TRIBO_RUNS (5) runs. docs/touch.md has the numbers.
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { fingers, launch } from "./test/browser.mjs";

const root = new URL("../../", import.meta.url).pathname, site = process.env.TRIBO_SITE_DIR ?? join(root, "build/web/site");
const runs = Number(process.env.TRIBO_RUNS ?? 5), material = process.env.TRIBO_MATERIAL ?? "carpet";
const types = { ".js": "text/javascript", ".wasm": "application/wasm", ".json": "application/json", ".jpg": "image/jpeg", ".html": "text/html" };
const html = `<!doctype html>
<html lang="en"><title>Carpet</title>
<script type="module" src="tribo-touch.js"></script>
<tribo-touch src="materials/${material}.json" poster="materials/${material}-${material}.jpg" alt="Carpet"></tribo-touch>
</html>`;

const server = createServer(async (request, response) => {
  const path = new URL(request.url, "http://localhost").pathname;
  try {
    const body = path === "/" ? Buffer.from(html) : await readFile(join(site, path)), packed = extname(path) !== ".jpg";
    response.writeHead(200, { "Content-Type": types[extname(path)] ?? "text/html", ...(packed ? { "Content-Encoding": "gzip" } : {}) });
    response.end(packed ? gzipSync(body, { level: 9 }) : body);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const address = `http://localhost:${server.address().port}/`;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const drawn = () => new Promise((done) => {
  const look = () => {
    const picture = document.querySelector("tribo-touch");
    if (picture?.shadowRoot?.querySelector(".drawn")) done(performance.now());
    else requestAnimationFrame(look);
  };
  look();
});

async function firstFrame(throttled) {
  const browser = await launch();
  const page = await (await browser.newContext({ viewport: { width: 412, height: 800 }, hasTouch: true })).newPage();
  const cdp = await page.context().newCDPSession(page);
  if (throttled) {
    await cdp.send("Network.enable");
    await cdp.send("Network.emulateNetworkConditions", { offline: false, latency: 150, downloadThroughput: 1.6e6 / 8, uploadThroughput: 0.75e6 / 8 });
    await cdp.send("Emulation.setCPUThrottlingRate", { rate: 4 });
  }
  // A visitor's browser is up already.
  await page.waitForTimeout(1500);
  await page.goto(address, { waitUntil: "commit" });
  const ms = await page.evaluate(drawn);
  const fetched = await page.evaluate(() => performance.getEntriesByType("resource").map((r) => `${r.name.split("/").pop()} ${Math.round(r.startTime)}-${Math.round(r.responseEnd)}`));
  await browser.close();
  return { ms, fetched };
}

// Processor time of the main thread for a frame of a sheet that moves as a whole; drawing itself is the GPU's.
async function frameWork() {
  const browser = await launch();
  const page = await (await browser.newContext({ viewport: { width: 512, height: 800 }, hasTouch: true })).newPage();
  await page.goto(address, { waitUntil: "commit" });
  await page.evaluate(drawn);
  const hand = await fingers(page);
  await hand.cdp.send("Performance.enable", { timeDomain: "threadTicks" });
  await page.evaluate(() => {
    window.frames = 0;
    const count = () => { ++window.frames; requestAnimationFrame(count); };
    requestAnimationFrame(count);
  });
  const spent = async () => Object.fromEntries((await hand.cdp.send("Performance.getMetrics")).metrics.map((m) => [m.name, m.value])).TaskDuration;
  const rub = async (moves) => {
    for (let i = 0; i < moves; ++i) await hand.touch([{ x: 100 + 5 * (i % 60), y: 200, radius: 90, force: 0.7 }]);
  };
  await rub(10);
  const [before, framesBefore] = [await spent(), await page.evaluate(() => window.frames)];
  await rub(60);
  const [after, framesAfter] = [await spent(), await page.evaluate(() => window.frames)];
  if (process.env.TRIBO_SHOTS) await page.screenshot({ path: join(process.env.TRIBO_SHOTS, `rub-${material}.png`) });
  await browser.close();
  return (1000 * (after - before)) / (framesAfter - framesBefore);
}

async function firstSample() {
  const browser = await launch();
  const page = await (await browser.newContext({ viewport: { width: 512, height: 800 }, hasTouch: true })).newPage();
  await page.addInitScript(() => {
    const Plain = window.AudioWorkletNode;
    window.AudioWorkletNode = class extends Plain {
      constructor(context, ...rest) {
        super(context, ...rest);
        const ear = new AnalyserNode(context, { fftSize: 256 }), wave = new Float32Array(256);
        this.connect(ear);
        setInterval(() => {
          ear.getFloatTimeDomainData(wave);
          if (window.heard === undefined && wave.some((v) => v !== 0)) window.heard = performance.now();
        }, 1);
      }
    };
  });
  await page.goto(address, { waitUntil: "commit" });
  await page.evaluate(drawn);
  // A finger made in the page: the browser's own protocol would be what is measured on a busy machine.
  const ms = await page.evaluate(async () => {
    const surface = document.querySelector("tribo-touch").shadowRoot.querySelector(".surface"), begin = performance.now();
    const finger = (type, x) => surface.dispatchEvent(new PointerEvent(type,
      { pointerId: 7, pointerType: "touch", isPrimary: true, clientX: x, clientY: 150, width: 40, height: 40, pressure: 0.7, button: 0, buttons: 1 }));
    finger("pointerdown", 100);
    for (let i = 0; window.heard === undefined && performance.now() - begin < 10_000; ++i) {
      finger("pointermove", 100 + 300 * Math.abs(Math.sin((performance.now() - begin) / 300)));
      await new Promise((done) => setTimeout(done, 4));
    }
    return window.heard - begin;
  });
  await browser.close();
  return ms;
}

// A frame of a whole 512 x 512 sheet in touch.wasm, ms: pressure, and step with normals.
async function engineWork() {
  const module = await WebAssembly.compile(await readFile(join(site, "touch.wasm")));
  const { exports: x } = await WebAssembly.instantiate(module, {});
  x._initialize();
  const sheet = x.sheet_create(512, 512, 1), press = [], step = [];
  x.sheet_set_material(sheet, 1, 1);
  for (let n = 0; n < 600; ++n) {
    new Float64Array(x.memory.buffer, x.sheet_contacts(sheet), 7).set([256 + (n % 2), 256, 64, 64, 0, 1 + 0.01 * (n % 7), 0]);
    const begin = performance.now();
    x.sheet_press(sheet, 1, 0, 0);
    const pressed = performance.now();
    x.sheet_step(sheet, 1 / 60, 0);
    x.sheet_normals(sheet, 0);
    if (n < 200) continue;
    press.push(pressed - begin);
    step.push(performance.now() - pressed);
  }
  return { press: median(press), step: median(step) };
}

async function several(measure) {
  const all = [];
  for (let i = 0; i < runs; ++i) all.push(await measure());
  return all;
}
const throttled = await several(() => firstFrame(true));
if (process.env.TRIBO_VERBOSE) console.error(throttled.map((t) => t.fetched.join("\n")).join("\n\n"));
const engine = await engineWork();
const said = {
  wasm_step_and_normals_ms: Number(engine.step.toFixed(3)),
  wasm_pressure_ms: Number(engine.press.toFixed(3)),
  first_frame_ms: Math.round(median(throttled.map((t) => t.ms))),
  first_frame_least_ms: Math.round(Math.min(...throttled.map((t) => t.ms))),
  first_frame_unthrottled_ms: Math.round(median((await several(() => firstFrame(false))).map((t) => t.ms))),
  frame_work_ms: Number(median(await several(frameWork)).toFixed(2)),
  gesture_to_sample_ms: Math.round(median(await several(firstSample))),
};
console.log(JSON.stringify(said));
server.close();
server.closeAllConnections();

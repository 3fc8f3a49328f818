// SPDX-License-Identifier: MIT
// npm run measure: what a visitor waits for, in headless Chromium against the built site, as JSON. First touchable frame of the
// five-line page at 1.6 Mbit/s and 150 ms with a processor four times slower; main-thread work of a frame of a whole 512 x 512
// sheet, and what of it is the engine's; gesture to first sample, cold. Medians of TRIBO_RUNS (5) runs. docs/touch.md has the numbers.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { TouchExports } from "@tribo/wasm/exports";
import { doublesAt } from "@tribo/wasm/memory";
import { instantiate } from "@tribo/wasm/module";
import type { CDPSession, Page } from "playwright-core";
import { fingers, launch, slowDown } from "../testing/browser.js";
import { serve } from "../testing/server.js";
import { SITE } from "../tools/places.js";

declare global {
  interface Window {
    drawnFrames: number;
    /** When the first sample that is not silence was heard, ms. */
    heard: number | undefined;
  }
}

const RUNS = Number(process.env.TRIBO_RUNS ?? 5);
const MATERIAL = process.env.TRIBO_MATERIAL ?? "carpet";
const PAGE = `<!doctype html>
<html lang="en"><title>Carpet</title>
<script type="module" src="tribo-touch.js"></script>
<tribo-touch src="materials/${MATERIAL}.json" poster="materials/${MATERIAL}-${MATERIAL}.jpg" alt="Carpet"></tribo-touch>
</html>`;

const server = await serve((path) => {
  const file = join(SITE, path);
  if (path === "/") return PAGE;
  return existsSync(file) ? readFileSync(file) : undefined;
});

const median = (values: number[]) => values.sort((a, b) => a - b)[values.length >> 1]!;

/** In the page: waits for the first touchable frame; when that was, ms. */
const drawn = () =>
  new Promise<number>((done) => {
    const look = () => {
      if (document.querySelector("tribo-touch")?.shadowRoot?.querySelector(".drawn")) done(performance.now());
      else requestAnimationFrame(look);
    };
    look();
  });

async function visit<T>(width: number, look: (page: Page) => Promise<T>): Promise<T> {
  const browser = await launch();
  try {
    return await look(await (await browser.newContext({ viewport: { width, height: 800 }, hasTouch: true })).newPage());
  } finally {
    await browser.close();
  }
}

const firstFrame = (throttled: boolean) =>
  visit(412, async (page) => {
    if (throttled) await slowDown(page);
    // A visitor's browser is up already.
    await page.waitForTimeout(1500);
    await page.goto(server.root, { waitUntil: "commit" });
    const ms = await page.evaluate(drawn);
    const fetched = await page.evaluate(() =>
      (performance.getEntriesByType("resource") as PerformanceResourceTiming[]).map(
        ({ name, startTime, responseEnd }) =>
          `${name.split("/").pop()} ${Math.round(startTime)}-${Math.round(responseEnd)}`,
      ),
    );
    if (process.env.TRIBO_VERBOSE) console.error(`${fetched.join("\n")}\n`);
    return ms;
  });

async function secondsSpent(cdp: CDPSession): Promise<number> {
  const { metrics } = await cdp.send("Performance.getMetrics");
  return metrics.find(({ name }) => name === "TaskDuration")!.value;
}

/** Processor time of the main thread for a frame of a sheet that moves as a whole, ms; drawing itself is the GPU's. */
const frameWork = () =>
  visit(512, async (page) => {
    await page.goto(server.root, { waitUntil: "commit" });
    await page.evaluate(drawn);
    const { cdp, touch } = await fingers(page);
    await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
    await page.evaluate(() => {
      window.drawnFrames = 0;
      const count = () => {
        ++window.drawnFrames;
        requestAnimationFrame(count);
      };
      requestAnimationFrame(count);
    });
    const rub = async (moves: number) => {
      for (let i = 0; i < moves; ++i) await touch([{ x: 100 + 5 * (i % 60), y: 200, radius: 90, force: 0.7 }]);
    };
    const now = async () => ({
      seconds: await secondsSpent(cdp),
      frames: await page.evaluate(() => window.drawnFrames),
    });
    await rub(10);
    const before = await now();
    await rub(60);
    const after = await now();
    if (process.env.TRIBO_SHOTS) await page.screenshot({ path: join(process.env.TRIBO_SHOTS, `rub-${MATERIAL}.png`) });
    return (1000 * (after.seconds - before.seconds)) / (after.frames - before.frames);
  });

/** From a gesture to its first sample, ms. */
const firstSample = () =>
  visit(512, async (page) => {
    await page.addInitScript(() => {
      window.AudioWorkletNode = class extends AudioWorkletNode {
        constructor(context: BaseAudioContext, ...rest: [string, AudioWorkletNodeOptions?]) {
          super(context, ...rest);
          const ear = new AnalyserNode(context, { fftSize: 256 });
          const wave = new Float32Array(256);
          this.connect(ear);
          setInterval(() => {
            ear.getFloatTimeDomainData(wave);
            if (window.heard === undefined && wave.some((v) => v !== 0)) window.heard = performance.now();
          }, 1);
        }
      };
    });
    await page.goto(server.root, { waitUntil: "commit" });
    await page.evaluate(drawn);
    // A finger made in the page: the browser's own protocol would be what is measured on a busy machine.
    return page.evaluate(async () => {
      const surface = document.querySelector("tribo-touch")!.shadowRoot!.querySelector(".surface")!;
      const begin = performance.now();
      const common = {
        pointerId: 7,
        pointerType: "touch",
        isPrimary: true,
        clientY: 150,
        width: 40,
        height: 40,
        pressure: 0.7,
        buttons: 1,
      };
      const finger = (type: string, clientX: number) =>
        surface.dispatchEvent(new PointerEvent(type, { ...common, clientX, button: 0 }));
      finger("pointerdown", 100);
      while (window.heard === undefined && performance.now() - begin < 10_000) {
        finger("pointermove", 100 + 300 * Math.abs(Math.sin((performance.now() - begin) / 300)));
        await new Promise((done) => setTimeout(done, 4));
      }
      return (window.heard ?? Number.NaN) - begin;
    });
  });

/** A frame of a whole 512 x 512 sheet in touch.wasm, ms: pressure, and step. */
async function engineWork(): Promise<{ press: number; step: number }> {
  const x = await instantiate<TouchExports>(await WebAssembly.compile(readFileSync(join(SITE, "touch.wasm"))));
  const sheet = x.sheet_create(512, 512, 1);
  const press: number[] = [];
  const step: number[] = [];
  x.sheet_set_material(sheet, 1, 1);
  for (let n = 0; n < 600; ++n) {
    doublesAt(x, x.sheet_contacts(sheet), 7).set([256 + (n % 2), 256, 64, 64, 0, 1 + 0.01 * (n % 7), 0]);
    const begin = performance.now();
    x.sheet_press(sheet, 1, 0, 0);
    const pressed = performance.now();
    x.sheet_step(sheet, 1 / 60, 0);
    if (n < 200) continue;
    press.push(pressed - begin);
    step.push(performance.now() - pressed);
  }
  return { press: median(press), step: median(step) };
}

async function several(measure: () => Promise<number>): Promise<number[]> {
  const all: number[] = [];
  for (let i = 0; i < RUNS; ++i) all.push(await measure());
  return all;
}
const throttled = await several(() => firstFrame(true));
const engine = await engineWork();
console.log(
  JSON.stringify({
    wasm_step_ms: Number(engine.step.toFixed(3)),
    wasm_pressure_ms: Number(engine.press.toFixed(3)),
    first_frame_ms: Math.round(median(throttled)),
    first_frame_least_ms: Math.round(Math.min(...throttled)),
    first_frame_unthrottled_ms: Math.round(median(await several(() => firstFrame(false)))),
    frame_work_ms: Number(median(await several(frameWork)).toFixed(2)),
    gesture_to_sample_ms: Math.round(median(await several(firstSample))),
  }),
);
await server.close();

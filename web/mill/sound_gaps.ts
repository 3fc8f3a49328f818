// SPDX-License-Identifier: MIT
// The gaps in the sound of the page without an engine, measured on its audio thread while other processes keep the processor busy.
import { spawn } from "node:child_process";
import type { Browser } from "playwright-core";
import { launch } from "../testing/browser.js";
import { serveFolder } from "../testing/server.js";
import { SITE } from "../tools/places.js";

export interface Gaps {
  /** The longest time in which the device got no samples, ms. */
  late_ms: number;
  /** The longest run of samples without a sound within a cut, ms. */
  silent_ms: number;
}

// Of the bowl's first cut, which has no pause: it begins later, and ends after LISTENED_S.
const LISTENED_S = 6;

// Around the processor of the page. Blocks come in bursts, so their lateness has a floor; a gap lifts it for good.
const METER = `{
  const register = registerProcessor;
  globalThis.registerProcessor = (name, Made) =>
    register(name, class extends Made {
      floor = Infinity; before = Infinity; until = 0; late = 0; quiet = 0; silent = 0; heard = 0;
      process(inputs, outputs) {
        const goesOn = super.process(inputs, outputs);
        this.floor = Math.min(this.floor, Date.now() - 1000 * currentTime);
        if (currentTime >= this.until) {
          if (this.before < Infinity) this.late = Math.max(this.late, this.floor - this.before);
          [this.before, this.floor, this.until] = [this.floor, Infinity, currentTime + 0.25];
        }
        for (const sample of outputs[0][0]) {
          if (sample !== 0) {
            if (this.heard > 0) this.silent = Math.max(this.silent, this.quiet);
            this.quiet = 0;
          } else ++this.quiet;
          this.heard += this.heard > 0 || sample !== 0 ? 1 : 0;
        }
        this.port.postMessage({ late_ms: this.late, silent_ms: 1000 * this.silent / sampleRate, heard_s: this.heard / sampleRate });
        return goesOn;
      }
    });
}\n`;

const TAKES = `{
  const Plain = AudioWorkletNode;
  window.AudioWorkletNode = class extends Plain {
    constructor(...all) {
      super(...all);
      this.port.onmessage = ({ data }) => (window.gaps = data);
    }
  };
}\n`;

async function listen(browser: Browser, root: string): Promise<Gaps> {
  const page = await browser.newPage({ reducedMotion: "reduce" });
  await page.addInitScript(TAKES);
  await page.goto(`${root}/mill/`);
  await page.click("#begin");
  await page.waitForFunction(
    (least) => ((window as unknown as { gaps?: { heard_s: number } }).gaps?.heard_s ?? 0) > least,
    LISTENED_S,
    { timeout: 120_000 },
  );
  const { late_ms, silent_ms } = (await page.evaluate("gaps")) as Gaps;
  await page.close();
  return { late_ms, silent_ms: Number(silent_ms.toFixed(2)) };
}

/** With so many processes that do nothing but count. */
export async function soundGaps(busy: number): Promise<Gaps> {
  const server = await serveFolder(SITE, (path, body) =>
    path.includes("sound_worklet") ? METER + Buffer.from(body).toString() : body,
  );
  const browser = await launch();
  const others = Array.from({ length: busy }, () => spawn(process.execPath, ["-e", "for (;;);"], { stdio: "ignore" }));
  try {
    return await listen(browser, server.root);
  } finally {
    for (const other of others) other.kill();
    await browser.close();
    await server.close();
  }
}

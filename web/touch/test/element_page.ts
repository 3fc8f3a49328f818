// SPDX-License-Identifier: MIT
// A page of the tests with <tribo-touch> on it, in headless Chromium. Each test file that imports this has a browser of
// its own.
import type { Browser, BrowserContext, BrowserContextOptions, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll } from "vitest";
import { hasBrowser, launch } from "../../testing/browser.js";
import type { ContactDetail, TriboErrorDetail, TriboTouch } from "../src/element.js";
import { serve, type Site } from "./site.js";

/** An event of #t, with its name. */
type Told = { n: string } & ContactDetail & TriboErrorDetail;

// What the pages of these tests keep.
declare global {
  interface Window {
    t: TriboTouch;
    log: Told[];
    flat: Uint8ClampedArray;
    set: number[];
    contexts: number;
    nodes: number;
    made: { webgl: number; audio: number; worklets: number; textures: number };
    gl: WebGL2RenderingContext;
    lose: WEBGL_lose_context;
    analyser: AnalyserNode | undefined;
    shakes: { ms: number; at: number }[];
    rumbles: [string, number][];
  }
}

export const kTag = '<tribo-touch id="t" src="sponge.json" alt="Yellow sponge" style="width:256px"></tribo-touch>';
const kScript = '<script type="module" src="/dist/tribo-touch.js"></script>';
/** The prototypes of browsers as a test changes them: one signature in place of many. */
export interface AnyCanvas {
  getContext(kind: string, ...rest: unknown[]): unknown;
}
export interface AnyNode {
  context: AudioContext;
  connect(to: AudioNode, ...rest: unknown[]): AudioNode;
}

export const kPatience = { timeout: 20_000 };
export let site: Site;
let browser: Browser;
let context: BrowserContext | undefined;
export let errors: string[] = [];

beforeAll(async () => {
  if (!hasBrowser) return;
  site = await serve();
  browser = await launch();
});
afterAll(async () => {
  await browser?.close();
  await site?.close();
});
afterEach(async () => {
  await context?.close();
  context = undefined;
  site?.blocked.clear();
});

/** A page with this body; events of #t are kept in window.log. */
export async function open(body: string, options: BrowserContextOptions & { before?: () => void } = {}): Promise<Page> {
  const { before, ...contextOptions } = options;
  context = await browser.newContext({ hasTouch: true, viewport: { width: 320, height: 320 }, ...contextOptions });
  const page = await context.newPage();
  errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  if (before !== undefined) await page.addInitScript(before);
  site.page(
    "/",
    `<script>window.log = [];
    for (const n of ["load", "error", "poster-dismissed", "contact-start", "contact-move", "contact-end"])
      document.addEventListener(n, (e) => e.target.localName === "tribo-touch" && log.push({ n, ...(e.detail ?? {}) }), true);
    </script>${kScript}${body}`,
  );
  await page.goto(`${site.root}/`);
  return page;
}
export const settled = (page: Page) =>
  page.waitForFunction(() => ["ready", "plain", "failed"].includes(window.t.state));
export const log = (page: Page, name: string) => page.evaluate((n) => window.log.filter((e) => e.n === n), name);
export const heap = (page: Page) =>
  page.evaluate(() => {
    const { gc, performance } = window as unknown as {
      gc?(): void;
      performance: { memory: { usedJSHeapSize: number } };
    };
    gc?.();
    return performance.memory.usedJSHeapSize;
  });
/** How many pixels of #t's canvas differ from what they were at the first call. */
export const changed = (page: Page) =>
  page.evaluate(() => {
    const canvas = window.t.shadowRoot!.querySelector("canvas")!;
    const now = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height).data;
    window.flat ??= now.slice();
    let count = 0;
    for (let i = 0; i < now.length; i += 4) if (Math.abs(now[i]! - window.flat[i]!) > 6) ++count;
    return count;
  });
export const frames = (page: Page, count: number) =>
  page.evaluate(
    (n) =>
      new Promise<void>((done) => {
        const next = () => {
          if (n-- > 0) requestAnimationFrame(next);
          else done();
        };
        next();
      }),
    count,
  );

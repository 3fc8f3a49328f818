// SPDX-License-Identifier: MIT
// Headless Chromium, and fingers on it by the browser's own protocol: touches with radius and force.
import { existsSync } from "node:fs";
import { chromium, type Browser, type CDPSession, type Page } from "playwright-core";

const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) =>
  existsSync(path),
);

export const hasBrowser = CHROMIUM !== undefined;
export const PATIENCE_MS = 120_000;

const QUIET = ["--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-component-update"];
/** Graphics in software, sound without a gesture, the garbage collector within reach. */
const ALL = [
  ...QUIET,
  "--disable-quic",
  "--disable-sync",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--autoplay-policy=no-user-gesture-required",
  "--js-flags=--expose-gc",
];

/** A browser whose pages may take PATIENCE_MS for a step: a busy machine needs longer than the half minute that it allows. */
async function started(args: string[]): Promise<Browser> {
  const browser = await chromium.launch({ executablePath: CHROMIUM, headless: true, args });
  const open = browser.newContext.bind(browser);
  browser.newContext = async (options) => {
    const context = await open(options);
    context.setDefaultTimeout(PATIENCE_MS);
    return context;
  };
  return browser;
}

export function launch(...more: string[]): Promise<Browser> {
  return started([...ALL, ...more]);
}
export function launchWithoutGraphics(): Promise<Browser> {
  return started([...QUIET, "--disable-3d-apis"]);
}

/** A text file, as an input of files takes it. */
export function file(name: string, text: string) {
  return { name, mimeType: "text/plain", buffer: Buffer.from(text) };
}

/** A slow phone's line and processor: 1.6 Mbit/s, 150 ms, four times slower. */
export async function slowDown(page: Page): Promise<void> {
  const cdp = await page.context().newCDPSession(page);
  await cdp.send("Network.enable");
  await cdp.send("Network.emulateNetworkConditions", {
    offline: false,
    latency: 150,
    downloadThroughput: 1.6e6 / 8,
    uploadThroughput: 0.75e6 / 8,
  });
  await cdp.send("Emulation.setCPUThrottlingRate", { rate: 4 });
}

export interface Point {
  x: number;
  y: number;
  id?: number;
  radius?: number;
  radiusY?: number;
  force?: number;
}

export interface Hand {
  /** What is on the screen from then on. */
  touch(points: Point[]): Promise<void>;
  cancel(): Promise<void>;
  cdp: CDPSession;
}

export async function fingers(page: Page): Promise<Hand> {
  const cdp = await page.context().newCDPSession(page);
  let down = 0;
  return {
    async touch(points) {
      const fewer = points.length === 0 || points.length < down;
      const type = fewer ? "touchEnd" : points.length > down ? "touchStart" : "touchMove";
      down = points.length;
      const touchPoints = points.map(({ x, y, id = 0, radius = 12, radiusY = radius, force = 0.6 }) => ({
        x,
        y,
        id,
        radiusX: radius,
        radiusY,
        force,
      }));
      await cdp.send("Input.dispatchTouchEvent", { type, touchPoints });
    },
    async cancel() {
      down = 0;
      await cdp.send("Input.dispatchTouchEvent", { type: "touchCancel", touchPoints: [] });
    },
    cdp,
  };
}

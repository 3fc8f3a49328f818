// SPDX-License-Identifier: MIT
// Headless Chromium and fingers on it, by the browser's own protocol: touches with radius and force.
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

const kChromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
export const hasBrowser = kChromium !== undefined;

export function launch(...more) {
  return chromium.launch({
    executablePath: kChromium,
    headless: true,
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
      "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--autoplay-policy=no-user-gesture-required", "--js-flags=--expose-gc", ...more],
  });
}

/** Fingers: touch([{x, y, id, radius, force}]) is what is on the screen from then on. */
export async function fingers(page) {
  const cdp = await page.context().newCDPSession(page);
  let down = 0;
  return {
    async touch(points) {
      const type = points.length === 0 ? "touchEnd" : points.length > down ? "touchStart" : points.length < down ? "touchEnd" : "touchMove";
      down = points.length;
      await cdp.send("Input.dispatchTouchEvent", {
        type,
        touchPoints: points.map((p) => ({ x: p.x, y: p.y, id: p.id ?? 0, radiusX: p.radius ?? 12, radiusY: p.radiusY ?? p.radius ?? 12, force: p.force ?? 0.6 })),
      });
    },
    async cancel() {
      down = 0;
      await cdp.send("Input.dispatchTouchEvent", { type: "touchCancel", touchPoints: [] });
    },
    cdp,
  };
}

// SPDX-License-Identifier: MIT
// VR with an emulated headset: the part on its bench, the controller as the finger, a pulse from the force.
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { hasBrowser, launch, PATIENCE_MS } from "../../testing/browser.js";
import { serveFolder, type Server } from "../../testing/server.js";
import { SITE } from "../../tools/places.js";

const IWER = join(dirname(createRequire(import.meta.url).resolve("iwer/package.json")), "build/iwer.min.js");

// What of the emulated headset is used here.
interface Actuator {
  pulse(strength: number, ms: number): Promise<boolean>;
}
interface Placed {
  position: { set(x: number, y: number, z: number): void };
  quaternion: { set(x: number, y: number, z: number, w: number): void };
}
interface Controller extends Placed {
  connected: boolean;
  inputSource: { gamepad: { hapticActuators: Actuator[] } };
}
interface Device extends Placed {
  installRuntime(options: { forceInstall: boolean }): void;
  controllers: { left: Controller; right: Controller };
  activeSession: XRSession | undefined;
}
declare global {
  interface Window {
    IWER: { XRDevice: new (model: object) => Device; metaQuest3: object };
    headset: { device: Device; pulses: number };
  }
}

describe.runIf(hasBrowser && existsSync(join(SITE, "mill/index.html")))("the page in VR", () => {
  let server: Server;
  let browser: Browser;
  let page: Page;
  const problems: string[] = [];

  beforeAll(async () => {
    server = await serveFolder(SITE);
    browser = await launch();
    page = await browser.newPage({ viewport: { width: 500, height: 400 } });
    page.on("pageerror", (error) => problems.push(error.message));
    await page.addInitScript(readFileSync(IWER, "utf8"));
    await page.addInitScript(() => {
      const { XRDevice, metaQuest3 } = window.IWER;
      const device = new XRDevice(metaQuest3);
      device.installRuntime({ forceInstall: true });
      const seen = (window.headset = { device, pulses: 0 });
      const watch = (actuator: Actuator) => {
        const pulse = actuator.pulse.bind(actuator);
        actuator.pulse = (strength: number, ms: number) => (++seen.pulses, pulse(strength, ms));
      };
      for (const side of ["left", "right"] as const)
        for (const actuator of device.controllers[side].inputSource.gamepad.hapticActuators) watch(actuator);
    });
    // Not the first visit, which begins with the film.
    await page.addInitScript(() => localStorage.setItem("tribo.film", "seen"));
    await page.goto(`${server.root}/mill/`);
    await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
  }, PATIENCE_MS);

  afterAll(async () => {
    await browser?.close();
    await server?.close();
  });

  it(
    "sets the part on a bench and lets the controller feel it",
    async () => {
      await page.waitForSelector("#vr:not([hidden])");
      await page.click("#vr");
      await page.waitForFunction(() => window.headset.device.activeSession !== undefined, null, {
        timeout: PATIENCE_MS,
      });
      // The bowl's block is 25 mm high on a bench of 950 mm, half a metre away; the finger's tip is 50 mm before
      // the controller, which points ahead.
      await page.evaluate(() => {
        const { device } = window.headset;
        device.position.set(0, 1.6, 0);
        device.controllers.right.position.set(0, 0.95 + 0.0245, -0.5 + 0.05);
        device.controllers.right.quaternion.set(0, 0, 0, 1);
        device.controllers.right.connected = true;
        device.controllers.left.connected = false;
      });
      await page.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "0") > 0.05, null, {
        timeout: PATIENCE_MS,
      });
      await page.waitForFunction(() => window.headset.pulses > 0, null, { timeout: PATIENCE_MS });
      await page.evaluate(() => window.headset.device.activeSession?.end());
      await page.waitForFunction(() => window.headset.device.activeSession === undefined, null, {
        timeout: PATIENCE_MS,
      });
      expect(problems).toEqual([]);
    },
    PATIENCE_MS,
  );
});

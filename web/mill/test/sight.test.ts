// SPDX-License-Identifier: MIT
// The bowl as it is drawn, in a few states, against small stored pictures (test/pictures). Faults that were there once are put
// into the graphics of the browser, to prove that these pictures would show them.
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, MillPage } from "../../testing/mill_page.js";
import { differing, small, stored } from "../../testing/pictures.js";

// Share of the pixels that may differ, and that a fault must change.
const SAME = 0.005;
const OTHER = 0.015;
// Beside the panels of a window of 1000 x 700.
const CLIP = { x: 260, y: 60, width: 470, height: 400 };
const path = (name: string) => join(import.meta.dirname, "pictures", `${name}.png`);

type Fault = "no shadow" | "coarse depth";
type Faulty = { fault?: Fault };

/** In the page: lets the graphics fail as `fault` says. */
function putFaults(shadowPixels: number): void {
  const faulty = window as unknown as Faulty;
  const gl = WebGL2RenderingContext.prototype;
  const { viewport, drawElements, drawArrays } = gl;
  let wide = 0;
  gl.viewport = function (x, y, width, height) {
    wide = width;
    viewport.call(this, x, y, width, height);
  };
  const drops = () => faulty.fault === "no shadow" && wide === shadowPixels;
  // Surfaces that lie on each other flicker, as with a near plane that is too near: 12 bits of 24 are left.
  const setDepth = (context: WebGL2RenderingContext) => {
    const coarse = faulty.fault === "coarse depth" && wide !== shadowPixels;
    context.depthRange(coarse ? 0.5 : 0, coarse ? 0.5 + 2 ** -12 : 1);
  };
  gl.drawElements = function (...all) {
    setDepth(this);
    if (!drops()) drawElements.apply(this, all);
  };
  gl.drawArrays = function (...all) {
    setDepth(this);
    if (!drops()) drawArrays.apply(this, all);
  };
}

type First = { drawnBefore?: number };

/** In the page: counts what is drawn after the first picture and before it is on its way to the screen. */
function watchFirst(): void {
  const first = window as First;
  const gl = WebGL2RenderingContext.prototype;
  let is: "awaited" | "drawn" | "made" | "shown" = "awaited";
  for (const how of ["drawElements", "drawArrays"] as const) {
    const draw = gl[how] as (...all: unknown[]) => void;
    (gl as unknown as Record<string, typeof draw>)[how] = function (...all) {
      if (is === "made") ++first.drawnBefore!;
      if (is === "awaited") {
        is = "drawn";
        first.drawnBefore = 0;
        void Promise.resolve().then(() => (is = "made"));
        requestAnimationFrame(() => setTimeout(() => (is = "shown")));
      }
      draw.apply(this, all);
    };
  }
}
// As in src/sight/light.ts.
const SHADOW_PIXELS = 2048;

describe.runIf(hasMillPage)("the bowl", () => {
  let mill: MillPage;
  let page: Page;

  beforeAll(async () => {
    mill = await MillPage.open({ look: "fine" });
    ({ page } = mill);
    await page.addInitScript(putFaults, SHADOW_PIXELS);
    await page.addInitScript(watchFirst);
    await page.emulateMedia({ reducedMotion: "reduce", colorScheme: "light" });
    await page.reload();
    await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
    // What lies over the picture is not looked at.
    await page.addStyleTag({ content: "#invitation { opacity: 0 }" });
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  // Without the panel, which would show the handles of the stock.
  const press = (id: string) => page.evaluate((of) => document.getElementById(of)!.click(), id);
  const colourBy = (value: string) =>
    page.evaluate((by) => {
      const select = document.getElementById("colouring") as HTMLSelectElement;
      select.value = by;
      select.dispatchEvent(new Event("change"));
    }, value);

  /** Sets the clock, s, and waits for the picture to stand still. */
  const at = async (time: number, clock: string) => {
    await page.fill("#time", String(time));
    await page.waitForFunction((want) => document.getElementById("clock")!.textContent.startsWith(want), clock, {
      timeout: PATIENCE_MS,
    });
    await still();
  };
  const still = async () => {
    let before = await small(page, CLIP);
    await expect
      .poll(
        async () => {
          const now = await small(page, CLIP);
          const off = await differing(page, before, now);
          before = now;
          return off;
        },
        { timeout: PATIENCE_MS, interval: 400 },
      )
      .toBe(0);
  };
  const off = async (name: string) => {
    const now = await small(page, CLIP);
    return differing(page, now, stored(path(name), now));
  };
  /** The share that a fault changes; the picture is drawn anew with it and without. */
  const withFault = async (fault: Fault, name: string) => {
    const set = async (now: Fault | undefined) => {
      await page.evaluate((f) => ((window as unknown as Faulty).fault = f), now);
      // The shadow is drawn again where something has moved.
      await press("show-positions");
      await press("show-positions");
      await still();
    };
    await set(fault);
    const changed = await off(name);
    await mill.picture(`fault ${fault}`);
    await set(undefined);
    return changed;
  };

  it("is on the screen before reflections and shadows are made", async () => {
    expect(await page.evaluate(() => (window as First).drawnBefore)).toBe(0);
  });

  it(
    "is a sawn block at first, on the ground in its own shadow",
    async () => {
      await at(0, "0:00");
      expect(await off("block")).toBeLessThan(SAME);
    },
    PATIENCE_MS,
  );

  it(
    "is half of grooves and half of block at half time, with the tool and the force curtain",
    async () => {
      await at(84, "1:24");
      expect(await off("half")).toBeLessThan(SAME);
      const changed = process.env.TRIBO_STORE_PICTURES ? 1 : await withFault("no shadow", "half");
      expect(changed).toBeGreaterThan(OTHER);
      expect(await off("half")).toBeLessThan(SAME);
    },
    2 * PATIENCE_MS,
  );

  it(
    "has the colours of the force",
    async () => {
      await colourBy("force");
      await still();
      expect(await off("force")).toBeLessThan(SAME);
      await colourBy("plain");
    },
    PATIENCE_MS,
  );

  it(
    "is grooved all over at the end, and its designed surface lies on it without flicker",
    async () => {
      await at(1000, "2:56");
      expect(await off("finished")).toBeLessThan(SAME);
      await press("show-designed");
      await still();
      expect(await off("designed")).toBeLessThan(SAME);
      const changed = process.env.TRIBO_STORE_PICTURES ? 1 : await withFault("coarse depth", "designed");
      expect(changed).toBeGreaterThan(OTHER);
      expect(await off("designed")).toBeLessThan(SAME);
      await press("show-designed");
    },
    2 * PATIENCE_MS,
  );

  it("is another picture in each state", async () => {
    const names = ["block", "half", "force", "finished", "designed"];
    const none = Buffer.alloc(0);
    for (const [n, name] of names.entries())
      for (const other of names.slice(n + 1))
        expect(await differing(page, stored(path(name), none), stored(path(other), none)), other).toBeGreaterThan(
          OTHER,
        );
  });
});

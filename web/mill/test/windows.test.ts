// SPDX-License-Identifier: MIT
// The part, its tool and what is said of them in windows of other shapes, in headless Chromium.
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { file, PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, JOB, MillPage, PROGRAM } from "../../testing/mill_page.js";
import { darkShare, redShare, type Clip } from "../../testing/pictures.js";

const PHONE = { width: 390, height: 844 };
// Pixels along a border.
const BORDER = 4;
const LONG = { timeout: PATIENCE_MS };

describe.runIf(hasMillPage)("the bench in other windows", () => {
  let mill: MillPage;
  let page: Page;

  beforeAll(async () => {
    // The plain light throws no shadow: what is dark is the part or its tool.
    mill = await MillPage.open({ look: "plain" });
    ({ page } = mill);
    await page.emulateMedia({ colorScheme: "light", reducedMotion: "reduce" });
    await page.setViewportSize(PHONE);
    await page.reload();
    await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
    await page.addStyleTag({ content: "#film-buttons, #begin, #examples, #learn-begin, #hint { opacity: 0 }" });
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  const box = async (id: string): Promise<Clip> => (await page.locator(`#${id}`).boundingBox())!;
  const dark = (clip: Clip) => () => darkShare(page, clip);
  const press = (id: string) => page.evaluate((of) => document.getElementById(of)!.click(), id);
  /** The lowest rows above a panel that lies over the stage. */
  const edgeAbove = async (id: string): Promise<Clip> => {
    const { x, y, width } = await box(id);
    return { x, y: y - BORDER, width, height: BORDER };
  };

  it(
    "shows all of the tool on a phone before the first cut",
    async () => {
      const { y, height } = await box("stage");
      await expect.poll(dark({ x: 0, y, width: PHONE.width, height }), LONG).toBeGreaterThan(0.1);
      for (const x of [0, PHONE.width - BORDER]) await expect.poll(dark({ x, y, width: BORDER, height }), LONG).toBe(0);
    },
    PATIENCE_MS,
  );

  it(
    "has colours up to the deviations that are there, and a legend that covers nothing",
    async () => {
      await page.fill("#time", "1000");
      await mill.removed(54.2);
      await page.evaluate(() => {
        const colouring = document.getElementById("colouring") as HTMLSelectElement;
        colouring.value = "deviation";
        colouring.dispatchEvent(new Event("change"));
      });
      // The scallops of the bowl are 0.278 mm high.
      await mill.until("0.3 mm left", "legend-high");
      expect(await page.inputValue("#scale")).toBe("0.3");
      await expect.poll(dark(await edgeAbove("legend")), LONG).toBe(0);
      await page.evaluate(() => {
        const colouring = document.getElementById("colouring") as HTMLSelectElement;
        colouring.value = "plain";
        colouring.dispatchEvent(new Event("change"));
      });
    },
    2 * PATIENCE_MS,
  );

  it(
    "shows all of a tilted tool on a phone after the last cut",
    async () => {
      const { y, height } = await box("stage");
      for (const x of [0, PHONE.width - BORDER]) await expect.poll(dark({ x, y, width: BORDER, height }), LONG).toBe(0);
    },
    PATIENCE_MS,
  );

  it(
    "keeps the part above a sheet that is open",
    async () => {
      for (const [button, sheet] of [
        ["show-program", "program"],
        ["show-panel", "panel"],
      ] as const) {
        await press(button);
        const { y } = await box("stage");
        const edge = await edgeAbove(sheet);
        await expect.poll(dark(edge), LONG).toBe(0);
        await expect.poll(dark({ x: 0, y, width: PHONE.width, height: edge.y - y }), LONG).toBeGreaterThan(0.05);
        await press(button);
      }
    },
    PATIENCE_MS,
  );

  it(
    "keeps the part in sight and the controls in reach in the lowest window",
    async () => {
      await page.setViewportSize({ width: 480, height: 300 });
      await expect.poll(async () => (await box("stage")).height, LONG).toBeGreaterThan(80);
      await expect.poll(dark(await box("stage")), LONG).toBeGreaterThan(0.05);
      await page.click("#more-lanes");
      await page.click("#more-lanes");
    },
    PATIENCE_MS,
  );

  it(
    "leaves half of a low wide window to the part when plots are open",
    async () => {
      const height = 720;
      await page.setViewportSize({ width: 1280, height });
      await press("show-plots");
      await expect.poll(async () => (await box("stage")).height, LONG).toBeGreaterThan(height / 2);
      const [lanes, plots] = [(await page.locator("footer").boundingBox())!, await box("plots")];
      expect(plots.y).toBe(lanes.y);
      expect(plots.x).toBeGreaterThan(lanes.x + lanes.width);
      expect(plots.width).toBeGreaterThan(500);
      await expect.poll(dark(await box("stage")), LONG).toBeGreaterThan(0.05);
      await press("show-plots");
    },
    PATIENCE_MS,
  );

  it(
    "shows all of a bad verdict on a phone, and marks the collision",
    async () => {
      await page.setViewportSize(PHONE);
      await mill.load(file("job.toml", JOB), file("p.nc", PROGRAM));
      await page.fill("#time", "1000");
      await page.waitForSelector('#verdict[data-damage="true"]', { timeout: PATIENCE_MS });
      const cutOff = () =>
        page.evaluate(() => {
          const { scrollHeight, clientHeight } = document.getElementById("cards")!;
          return scrollHeight - clientHeight;
        });
      await expect.poll(cutOff, LONG).toBe(0);
      const stage = await box("stage");
      expect(await redShare(page, stage)).toBe(0);
      await page.click("#verdict-places button[data-kind=damage]");
      await expect.poll(() => redShare(page, stage), LONG).toBeGreaterThan(0.0003);
    },
    PATIENCE_MS,
  );

  it(
    "says a collision once; on a tablet nothing of the verdict is cut off",
    async () => {
      await page.setViewportSize({ width: 820, height: 1180 });
      await mill.load(file("job.toml", JOB), file("p.nc", PROGRAM));
      await page.fill("#time", "1000");
      await page.waitForSelector('#verdict[data-damage="true"]', { timeout: PATIENCE_MS });
      expect(await page.isVisible("#collisions")).toBe(false);
      // A second one: it is deeper in the same rapid.
      await mill.load(file("p.nc", `${PROGRAM}G0 Z5\nG0 X5 Y12\nG0 Z-3\n`));
      await page.fill("#time", "1000");
      await page.waitForSelector("#collisions:not([hidden])", { timeout: PATIENCE_MS });
      await mill.picture("tablet_collisions");
      const hidden = () =>
        page.evaluate(() => {
          const { scrollHeight, clientHeight, scrollWidth, clientWidth } = document.getElementById("cards")!;
          return [scrollHeight - clientHeight, scrollWidth - clientWidth];
        });
      await expect.poll(hidden, LONG).toEqual([0, 0]);
      expect((await box("verdict")).width).toBeGreaterThan((await box("collisions")).width);
    },
    PATIENCE_MS,
  );

  it("makes no error", () => expect(mill.problems).toEqual([]));
});

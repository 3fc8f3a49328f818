// SPDX-License-Identifier: MIT
// report.html as `tribo render` writes it, opened as a file: the part in 3D, without a network, and without WebGL.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { hasBrowser, launch, launchWithoutGraphics, PATIENCE_MS } from "../../testing/browser.js";
import { jobText } from "../../testing/job.js";
import { coloursOf, watch } from "../../testing/offline_page.js";
import { PROGRAM } from "../../tools/places.js";

// Kept to be looked at, if TRIBO_PICTURES names a folder.
const PAPER = process.env.TRIBO_PICTURES && join(process.env.TRIBO_PICTURES, "report.pdf");
const JOB = jobText(
  "[[0, 0, -8], [40, 20, 0]]",
  `[part]
surface = "plane.stl"
[[mode]]
direction = [1, 0, 0]
frequency_hz = 900
damping_ratio = 0.02
stiffness_n_per_mm = 900
`,
);
const PROGRAM_TEXT = "G21 G90\nG0 X-5 Y5 Z5\nG1 Z-2\nG1 X45\nG0 Z5\nG0 Y9 X-5\nG1 Z-2\nG1 X45\n";
// Where the two grooves end, as one square.
const corner = (x: number, y: number) => `vertex ${x} ${y} -2\n`;
const facet = (...corners: string[]) => `facet normal 0 0 1\nouter loop\n${corners.join("")}endloop\nendfacet\n`;
const PLANE = `solid plane\n${facet(corner(0, 3), corner(40, 3), corner(40, 11))}${facet(corner(0, 3), corner(40, 11), corner(0, 11))}endsolid\n`;

describe.runIf(hasBrowser && existsSync(PROGRAM))("the report", () => {
  let folder: string;
  let browser: Browser;
  let page: Page;
  let asked: string[];
  let problems: string[];
  let address: string;

  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "tribo-report-"));
    writeFileSync(join(folder, "job.toml"), JOB);
    writeFileSync(join(folder, "p.nc"), PROGRAM_TEXT);
    writeFileSync(join(folder, "plane.stl"), PLANE);
    execFileSync(PROGRAM, ["render", join(folder, "job.toml"), "--out", join(folder, "out"), "--resolution", "0.25"]);
    address = pathToFileURL(join(folder, "out/report.html")).href;
    browser = await launch();
    page = await browser.newPage({ viewport: { width: 900, height: 700 } });
    ({ asked, problems } = watch(page));
    await page.goto(address);
    await page.waitForFunction(() => document.querySelector("#part-view img")?.hasAttribute("hidden"));
  }, PATIENCE_MS);

  afterAll(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  const view = () => coloursOf(page, "#part-view canvas");

  it("is one file of less than 5 MB that asks for nothing else", () => {
    expect(asked.filter((url) => !url.startsWith("data:"))).toEqual([address]);
    expect(statSync(join(folder, "out/report.html")).size).toBeLessThan(5e6);
    expect(problems).toEqual([]);
  });

  it("prints a set-up sheet, tools, files and the worst lines, and nothing for a hand", async () => {
    const sheet = (await page.textContent("#sheet"))!;
    for (const said of [
      "Set-up sheet",
      "40 x 20 x 8 mm, from (0, 0, -8) to (40, 20, 0) mm",
      "ball 6 flutes 2",
      "not given",
    ])
      expect(sheet).toContain(said);
    for (const text of [JOB, PROGRAM_TEXT, PLANE])
      expect(sheet).toContain(createHash("sha256").update(text).digest("hex"));
    expect(await page.textContent("#written")).toMatch(/^Written .*20\d\d/);
    // Both grooves, the wider step first.
    const lines = page.locator("#sheet section").first().locator("tr");
    expect(await lines.count()).toBe(3);
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    try {
      for (const hidden of [".scrub", ".choices", "audio", ".readout"])
        for (const one of await page.locator(hidden).all()) expect(await one.isVisible()).toBe(false);
      expect(await page.evaluate(() => getComputedStyle(document.body).backgroundColor)).toBe("rgb(255, 255, 255)");
      const paper = await page.pdf({ preferCSSPageSize: true, printBackground: true, path: PAPER });
      expect(paper.length).toBeLessThan(3e6);
    } finally {
      await page.emulateMedia({ media: null, colorScheme: null });
    }
    expect(problems).toEqual([]);
  });

  it("draws growth and vibration of a job that says what bends, and colours the path by it", async () => {
    const painted = (id: string) =>
      page.evaluate((name) => {
        const canvas = document.querySelector<HTMLCanvasElement>(`#${name}`)!;
        const bytes = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height).data;
        let sum = 0;
        for (let n = 0; n < bytes.length; n += 4) if (bytes[n + 3]! > 0) sum += bytes[n]! + (n % 1009);
        return sum;
      }, id);
    expect(await painted("chatter-plot")).toBeGreaterThan(10_000);
    expect(await painted("vibration-plot")).toBeGreaterThan(10_000);
    expect(await page.locator("#chatter .chart svg").count()).toBe(1);
    const byForce = await painted("path-plot");
    await page.check('#colouring input[value="mu"]');
    expect(await painted("path-plot")).not.toBe(byForce);
    expect(await page.textContent("#readout")).toContain("a vibration grows by");
    await page.evaluate(() => window.scrollTo(0, 0));
    expect(problems).toEqual([]);
  });

  it(
    "draws machined surface, untouched stock and the tool's tip",
    async () => {
      const seen = await view();
      expect(seen.drawn).toBeGreaterThan(30_000);
      expect(seen.bright).toBeGreaterThan(5_000);
      expect(seen.dull).toBeGreaterThan(5_000);
      expect(seen.yellow).toBeGreaterThan(20);
    },
    PATIENCE_MS,
  );

  it(
    "turns and comes nearer by mouse and keyboard, and comes back",
    async () => {
      const first = await view();
      const box = await page.locator("#part-view canvas").boundingBox();
      if (!box) throw new Error("no view");
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x + 80, y + 20, { steps: 4 });
      await page.mouse.up();
      const turned = await view();
      expect(turned.sum).not.toBe(first.sum);
      await page.focus("#part-view canvas");
      await page.keyboard.press("+");
      await page.keyboard.press("+");
      const near = await view();
      expect(near.drawn).toBeGreaterThan(1.2 * turned.drawn);
      await page.keyboard.press("ArrowLeft");
      expect((await view()).sum).not.toBe(near.sum);
      await page.mouse.wheel(0, 300);
      await expect.poll(async () => (await view()).drawn, { timeout: PATIENCE_MS }).toBeLessThan(near.drawn);
      await page.keyboard.press("Home");
      expect((await view()).sum).toBe(first.sum);
    },
    PATIENCE_MS,
  );

  it(
    "follows the row that the plots point at",
    async () => {
      const before = await view();
      await page.fill("#row", "0");
      expect((await view()).sum).not.toBe(before.sum);
    },
    PATIENCE_MS,
  );

  it(
    "colours the part by its deviation",
    async () => {
      expect(await page.locator("#part-view .scale").isHidden()).toBe(true);
      await page.check("#part-view input[value=deviation]");
      const seen = await view();
      expect(seen.purple).toBeGreaterThan(1_000);
      expect(await page.locator("#part-view .scale").textContent()).toMatch(/mm gouge0\+[\d.]+ mm left/);
      await page.check("#part-view input[value=surface]");
    },
    PATIENCE_MS,
  );

  it("says what it is and how it is used", async () => {
    const canvas = page.locator("#part-view canvas");
    expect(await canvas.getAttribute("aria-label")).toBe("The part as milled");
    expect(await page.locator("#part-hint").innerText()).toContain("arrow keys");
  });

  it(
    "looks the part in the dark too",
    async () => {
      await page.emulateMedia({ colorScheme: "dark" });
      expect((await view()).bright).toBeGreaterThan(5_000);
      await page.emulateMedia({ colorScheme: "light" });
    },
    PATIENCE_MS,
  );

  it(
    "keeps the picture where there is no WebGL",
    async () => {
      const plain = await launchWithoutGraphics();
      try {
        const without = await plain.newPage();
        await without.goto(address);
        await without.waitForFunction(() => document.getElementById("readout")?.textContent !== "");
        expect(await without.locator("#part-view img").isVisible()).toBe(true);
        expect(await without.locator("#part-view canvas").isVisible()).toBe(false);
      } finally {
        await plain.close();
      }
    },
    PATIENCE_MS,
  );
});

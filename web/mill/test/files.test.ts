// SPDX-License-Identifier: MIT
// What goes into the page without an engine: jobs, programs, drops, set-ups, recordings.
import { readFileSync, truncateSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, JOB, MillPage, PROGRAM } from "../../testing/mill_page.js";

const SURFACE = "v 0 0 -2\nv 30 0 -2\nv 30 16 -2\nv 0 16 -2\nf 1 2 3\nf 1 3 4\n";

describe.runIf(hasMillPage)("files of the page without an engine", () => {
  let mill: MillPage;
  let choose: MillPage["choose"];
  let load: MillPage["load"];
  let folder: MillPage["folder"];
  let page: MillPage["page"];
  let picture: MillPage["picture"];
  let removed: MillPage["removed"];
  let text: MillPage["text"];
  let until: MillPage["until"];

  beforeAll(async () => {
    mill = await MillPage.open();
    ({ choose, folder, load, page, picture, removed, text, until } = mill);
    await page.click("#show-panel");
  }, PATIENCE_MS);

  afterAll(() => mill?.close());

  it(
    "takes the bands from cases where the run-out has a spread",
    async () => {
      const coefficients = ["ktc", "krc", "kac"].map((k) => `${k}_n_per_mm2 = 500\n${k[0]}${k[1]}e_n_per_mm = 0`);
      const job = JOB.replace('name = "al7075-t6"', coefficients.join("\n")).replace(
        "helix",
        "runout_mm = 0.02\nrunout_spread = 1\nhelix",
      );
      await load(file("uneven.toml", job), file("p.nc", PROGRAM));
      await until("uneven.toml", "job");
      await page.fill("#time", "1.2");
      await until("N", "peak");
      await page.waitForSelector("#cases:visible", { timeout: PATIENCE_MS });
      expect(await page.isVisible("#band-row")).toBe(false);
      await page.check("#cases");
      await until("40 cases", "case-count");
      await page.waitForSelector("#band-row:visible", { timeout: PATIENCE_MS });
      await expect.poll(() => text("could-be"), { timeout: PATIENCE_MS }).toMatch(/^\d+ to \d+ N$/);
      await picture("cases");
      await page.uncheck("#cases");
      await page.waitForSelector("#band-row", { state: "hidden", timeout: PATIENCE_MS });
      await load(file("job.toml", JOB), file("p.nc", PROGRAM));
      expect(await page.isVisible("#cases")).toBe(true);
      expect(await page.isChecked("#cases")).toBe(false);
      await page.fill("#time", "1000");
      await removed(0.3);
    },
    PATIENCE_MS,
  );

  it(
    "records, and plays the recording again",
    async () => {
      await until("rapid through stock", "collisions");
      // So slowly that the recording ends before the collision.
      await page.selectOption("#speed", "0.5");
      await page.click("#record");
      await page.click("#play");
      await until("Pause", "play");
      // So long that a busy machine sees it play.
      await page.waitForTimeout(3000);
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#record")]);
      const path = join(folder, "run.tribo");
      await download.saveAs(path);
      await page.setInputFiles("#files", path);
      await until("run.tribo", "job");
      // It plays by itself, and ends.
      await until("Pause", "play");
      await until("Play", "play");
      for (const now of ["Pause", "Play", "Pause"]) {
        await page.click("#play");
        await until(now, "play");
      }
      // The collision that was before the recording stops nothing.
      expect(await page.isVisible("#notice-box")).toBe(false);
      await page.selectOption("#speed", "1");
      writeFileSync(path, readFileSync(path).subarray(0, 1000));
      await page.setInputFiles("#files", path);
      await until("run.tribo: the recording is cut off", "notice");
    },
    PATIENCE_MS,
  );

  it(
    "takes a drop, a program alone and a surface after it",
    async () => {
      await page.evaluate(
        (program) => {
          const data = new DataTransfer();
          data.items.add(new File([program], "alone.nc"));
          for (const kind of ["dragenter", "dragover", "drop"])
            window.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
        },
        PROGRAM.replace("G21", "G21 S8000 F600"),
      );
      await until("alone.nc", "job");
      await until("is not described", "warnings");
      expect(await page.isVisible("#said")).toBe(true);
      await choose(file("surface.obj", SURFACE));
      await page.waitForSelector("#designed-label:not([hidden])", { timeout: PATIENCE_MS });
      await page.selectOption("#speed", "50");
      await page.click("#play");
      await removed(0.3);
      for (const by of ["deviation", "scallop"]) {
        await page.selectOption("#colouring", by);
        await page.waitForTimeout(400);
        await picture(`colour-${by}`);
      }
      await page.selectOption("#colouring", "deviation");
      await page.fill("#tolerance", "3");
      await page.dispatchEvent("#tolerance", "change");
      await until("within ± 3 mm", "within");
      expect(await page.isVisible("#histogram")).toBe(true);
      await page.selectOption("#colouring", "plain");
      await page.click("#show-designed");
      await page.click("#show-designed");
    },
    PATIENCE_MS,
  );

  it(
    "shows what a program was milled with, mills it as it is changed, and saves the job",
    async () => {
      await load(file("mine.nc", PROGRAM.replace("G21", "G21 S8000 F600")));
      await until("mine.nc", "job");
      await expect.poll(() => page.inputValue("#job-text"), { timeout: PATIENCE_MS }).toContain('gcode = "mine.nc"');
      expect(await page.getAttribute("#setup-back", "disabled")).not.toBeNull();
      await page.fill("#setup-form label:has-text('diameter') input", "4.5");
      await page.press("#setup-form label:has-text('diameter') input", "Enter");
      await page.selectOption("#setup-form label:has-text('material') select", "al6082-t6");
      await page.fill("#setup-form [aria-label='stock to z']", "-0.5");
      await page.press("#setup-form [aria-label='stock to z']", "Enter");
      const told = await page.inputValue("#job-text");
      for (const part of ["diameter_mm = 4.5", 'name = "al6082-t6"', "-0.5]]"]) expect(told).toContain(part);
      await page.click("#mill-again");
      await until("mine.toml", "job");
      expect(await page.inputValue("#job-text")).toBe(told);
      await picture("set-up");
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-job")]);
      expect(download.suggestedFilename()).toBe("mine.toml");
      await page.waitForSelector("#setup-back:not([disabled])", { timeout: PATIENCE_MS });
      await page.click("#setup-back");
      await expect.poll(() => page.inputValue("#job-text"), { timeout: PATIENCE_MS }).toContain("diameter_mm = 6\n");
      // What cannot be milled is said, and what is milled stays.
      await page.fill("#setup-form label:has-text('diameter') input", "-1");
      await page.press("#setup-form label:has-text('diameter') input", "Enter");
      await page.click("#mill-again");
      await until("diameter_mm", "notice");
      await page.click("#dismiss");
    },
    PATIENCE_MS,
  );

  it(
    "asks for the machine of a program that turns axes, and for nothing else",
    async () => {
      await choose(file("five.nc", "G21 G90 S8000 M3\nG0 X0 Y0 Z5 A0 C0\nG1 Z-1 A10 C20 F300\nX30 A20\nG0 Z9\nM30\n"));
      await page.waitForSelector("#ask-machine:not([hidden])", { timeout: PATIENCE_MS });
      expect(await page.isVisible("#notice-box")).toBe(false);
      expect(await violations(page)).toEqual([]);
      await picture("machine");
      await page.selectOption("#machine-choice select", "xyzac-trt");
      await page.click("#ask-machine button");
      await until("five.toml", "job");
      await page.waitForSelector("#ask-machine", { state: "hidden" });
      await page.selectOption("#speed", "50");
      await page.click("#begin");
      await removed(0.001);
    },
    PATIENCE_MS,
  );

  it(
    "lists a hundred places and counts the rest",
    async () => {
      const dives = Array.from(
        { length: 120 },
        (_, n) => `G0 X${2 * (n % 14) + 2} Y${1.5 * Math.floor(n / 14) + 1}\nG0 Z-${1 + n / 60}\nG0 Z5\n`,
      );
      await load(file("job.toml", JOB), file("p.nc", `G21 G90\nG0 Z5\n${dives.join("")}`));
      await page.selectOption("#speed", "50");
      await page.click("#play");
      await until("The clock stands", "notice");
      await until("Play", "play");
      await page.click("#play");
      await until("and 20 more", "collisions");
      expect(await page.locator("#collisions li").count()).toBe(100);
      await load(file("alone.nc", PROGRAM.replace("G21", "G21 S8000 F600")));
      await until("alone.nc", "job");
      await page.waitForSelector("#collisions", { state: "hidden", timeout: PATIENCE_MS });
    },
    PATIENCE_MS,
  );

  it(
    "says what is wrong with a file, and where",
    async () => {
      const told = async (what: string, ...files: ReturnType<typeof file>[]) => {
        await choose(...files);
        await until(what, "notice");
      };
      await told(
        "job.toml:2:1: error: unknown key 'boxx_mm' in [stock]",
        file("job.toml", JOB.replace("box_mm", "boxx_mm")),
        file("p.nc", PROGRAM),
      );
      await told("p.nc: error: the file is not here", file("job.toml", JOB));
      await told("bad.nc:2:", file("bad.nc", "G21 G90\nG1 X[1/0] F100\n"));
      await told("a model alone says no path", file("a.stl", ""), file("b.stl", ""));
      await told("is neither a job nor a program", file("letter.doc", "Dear all,\n"));
      const big = join(folder, "big.nc");
      writeFileSync(big, "");
      truncateSync(big, 100e6);
      await page.setInputFiles("#files", big);
      await until("big.nc: 100 MB are more than a page can hold", "notice");
      // What was there goes on.
      expect(await text("job")).toBe("alone.nc");
    },
    PATIENCE_MS,
  );

  it("makes no error", () => {
    expect(mill.foreign).toEqual([]);
    expect(mill.problems).toEqual([]);
  });
});

// SPDX-License-Identifier: MIT
// The page without an engine shows, sounds and is worked, in headless Chromium.
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { EXAMPLES, WIDE } from "../src/gallery/list.js";
import { feelAt, hasMillPage, JOB, MillPage, PROGRAM } from "../../testing/mill_page.js";
import { differing, small } from "../../testing/pictures.js";

describe.runIf(hasMillPage)("the page without an engine", () => {
  let mill: MillPage;
  let browser: MillPage["browser"];
  let load: MillPage["load"];
  let foreign: MillPage["foreign"];
  let loaded: MillPage["loaded"];
  let page: MillPage["page"];
  let picture: MillPage["picture"];
  let problems: MillPage["problems"];
  let removed: MillPage["removed"];
  let server: MillPage["server"];
  let text: MillPage["text"];
  let until: MillPage["until"];

  beforeAll(async () => {
    mill = await MillPage.open({ look: "auto" });
    ({ browser, foreign, load, loaded, page, picture, problems, removed, server, text, until } = mill);
  }, PATIENCE_MS);

  afterAll(() => mill?.close());

  it("lets no other site and no text in it run a script", async () => {
    const tried = await browser.newPage();
    await tried.goto(`${server.root}/mill/`);
    const ran = await tried.evaluate(async () => {
      const refused: string[] = [];
      document.addEventListener("securitypolicyviolation", (event) => refused.push(event.effectiveDirective));
      document.body.insertAdjacentHTML("beforeend", '<img src="data:," onerror="window.ran = true">');
      const script = document.createElement("script");
      script.textContent = "window.ran = true";
      document.body.append(script);
      await fetch("https://example.com/").catch(() => undefined);
      await new Promise((done) => setTimeout(done, 100));
      return { ran: "ran" in window, refused: [...new Set(refused)].sort() };
    });
    await tried.close();
    expect(ran).toEqual({ ran: false, refused: ["connect-src", "script-src-attr", "script-src-elem"] });
  });

  it("links to the licences of what it is made of", async () => {
    const link = await page.locator('aside a[href="notices.txt"]').getAttribute("href");
    const licences = await (await fetch(`${server.root}/mill/${link}`)).text();
    for (const holder of ["three.js authors", "Leon Sorokin"]) expect(licences).toContain(holder);
  });

  it("opens with the bowl, ready to be milled, in little", async () => {
    expect(await text("job")).toBe("bowl.toml");
    await picture("bowl");
    const app = loaded.filter((l) => /\.(html|js|css)$|\/$/.test(l.url)).reduce((sum, l) => sum + l.bytes, 0);
    expect(app).toBeGreaterThan(50_000);
    expect(app).toBeLessThan(200_000);
  });

  it(
    "mills a job that is chosen with its files",
    async () => {
      await load(file("job.toml", JOB), file("p.nc", PROGRAM));
      await until("job.toml", "job");
      await page.selectOption("#speed", "5");
      await page.click("#begin");
      await removed(0.3);
      await until("rapid through stock", "collisions");
      // The clock stops at the first collision.
      await until("The clock stands", "notice");
      await until("Play", "play");
      await page.click("#dismiss");
      await picture("job");
    },
    PATIENCE_MS,
  );

  it(
    "shows the program with the load of its lines, and goes to a line that is clicked",
    async () => {
      expect(await text("program-name")).toBe("p.nc");
      expect(await text("program-line-4")).toBe("4G1 X35");
      const bars = async (line: number) => page.locator(`#program-line-${line} i`).count();
      expect([await bars(1), await bars(4), await bars(8)]).toEqual([0, 1, 1]);
      await page.click("#program-line-4");
      await page.waitForSelector('#program-line-4[aria-selected="true"]', { timeout: PATIENCE_MS });
      await page.focus("#program-lines");
      for (const key of ["ArrowDown", "ArrowDown", "ArrowDown", "ArrowUp", "Enter"]) await page.keyboard.press(key);
      await page.waitForSelector('#program-line-6[aria-selected="true"]', { timeout: PATIENCE_MS });
      // Also where the lines are drawn while the button is down, as while the clock runs.
      const box = (await page.locator("#program-line-4").boundingBox())!;
      await page.mouse.move(box.x + 40, box.y + box.height / 2);
      await page.mouse.down();
      await page.evaluate(async () => {
        document.getElementById("program-lines")!.dispatchEvent(new Event("scroll"));
        for (let n = 0; n < 2; ++n) await new Promise((done) => requestAnimationFrame(done));
      });
      await page.mouse.up();
      await page.waitForSelector('#program-line-4[aria-selected="true"]', { timeout: PATIENCE_MS });
    },
    PATIENCE_MS,
  );

  it(
    "has one axis of time: a click on the lanes sets the clock",
    async () => {
      const seconds = (clock: string) => clock.split(":").reduce((sum, part) => 60 * sum + parseFloat(part), 0);
      const box = (await page.locator("#time").boundingBox())!;
      await page.mouse.click(box.x + 0.5 * box.width, box.y + 20);
      const [, end] = (await text("clock")).split(" / ");
      await expect
        .poll(async () => Math.abs(seconds((await text("clock")).split(" / ")[0]!) - 0.5 * seconds(end!)), {
          timeout: PATIENCE_MS,
        })
        .toBeLessThan(1.1);
      const colours = await page.evaluate(() => {
        const lanes = document.getElementById("lanes") as HTMLCanvasElement;
        return new Set(lanes.getContext("2d")!.getImageData(0, 0, lanes.width, lanes.height).data).size;
      });
      expect(colours).toBeGreaterThan(40);
      const few = (await page.locator("#lanes").boundingBox())!.height;
      await page.click("#more-lanes");
      expect((await page.locator("#lanes").boundingBox())!.height).toBeGreaterThan(1.5 * few);
      await picture("lanes");
      await page.click("#more-lanes");
      expect((await page.locator("#lanes").boundingBox())!.height).toBe(few);
    },
    PATIENCE_MS,
  );

  it(
    "has a verdict, with places to look at and the band of the force",
    async () => {
      // The clock was set back: the rapid is still to come.
      await page.fill("#time", "1000");
      await until("Play", "play");
      await page.waitForSelector('#verdict[data-damage="true"]', { timeout: PATIENCE_MS });
      expect(await page.locator("#verdict-places li").count()).toBeGreaterThan(0);
      await until("rapid through stock", "verdict-places");
      expect(await text("verdict-sentence")).toMatch(/^(No|Yes|Not sure|So far)/);
      const before = await text("clock");
      await page.click("#verdict-places button[data-kind=damage]");
      await expect.poll(() => text("clock"), { timeout: PATIENCE_MS }).not.toBe(before);
      await page.fill("#time", "1.2");
      await page.waitForSelector("#band-row:not([hidden])", { timeout: PATIENCE_MS });
      await expect.poll(() => text("could-be"), { timeout: PATIENCE_MS }).toMatch(/^\d+ to \d+ N$/);
      await page.waitForSelector("#share-row:not([hidden])", { timeout: PATIENCE_MS });
      expect(await text("share")).toMatch(/^\d+ %$/);
    },
    PATIENCE_MS,
  );

  it(
    "sounds at the tooth's frequency while it cuts, and not where it is paused",
    async () => {
      await page.selectOption("#speed", "0.1");
      await page.fill("#time", "1.2");
      await page.click("#play");
      await until("Pause", "play");
      expect(await page.getAttribute("#sound", "aria-pressed")).toBe("true");
      const level = () =>
        page.evaluate(() => {
          const { meter } = window as unknown as { meter: AnalyserNode };
          const db = new Float32Array(meter.frequencyBinCount);
          meter.getFloatFrequencyData(db);
          const bin = meter.context.sampleRate / meter.fftSize;
          let top = 0;
          // Below the chips' noise.
          for (let n = Math.ceil(60 / bin); n < 1000 / bin; ++n) if (db[n]! > db[top]! || top === 0) top = n;
          return { hz: top * bin, db: db[top] };
        });
      // 9000 rpm, two teeth: 300 Hz or a harmonic of it.
      await expect.poll(async () => (await level()).db, { timeout: PATIENCE_MS }).toBeGreaterThan(-70);
      await page.waitForTimeout(500);
      const { hz } = await level();
      expect(Math.abs(hz / 300 - Math.round(hz / 300))).toBeLessThan(0.03);
      await page.click("#play");
      await until("Play", "play");
      await expect.poll(async () => (await level()).db, { timeout: PATIENCE_MS }).toBeLessThan(-120);
      await page.click("#sound");
      expect(await page.getAttribute("#sound", "aria-pressed")).toBe("false");
      await page.click("#sound");
    },
    PATIENCE_MS,
  );

  it(
    "turns with a drag that begins on the part, and feels with the same drag in its mode",
    async () => {
      const box = (await page.locator("#stage").boundingBox())!;
      const [x, y] = [box.x + 0.5 * box.width, box.y + 0.62 * box.height];
      const drag = async () => {
        await page.mouse.move(x, y);
        // At once: on a busy machine a wait in between would be a long press.
        await Promise.all([page.mouse.down(), page.mouse.move(x + 40, y, { steps: 2 })]);
        const touching = await page.evaluate(() => document.getElementById("scene")!.className.includes("touching"));
        await page.mouse.up();
        // The finger that hovers is no part of the picture.
        await page.mouse.move(1, 1);
        return touching;
      };
      const before = await small(page, box);
      expect(await drag()).toBe(false);
      const turned = () => small(page, box).then((now) => differing(page, before, now));
      await expect.poll(turned, { timeout: PATIENCE_MS }).toBeGreaterThan(0.02);
      await page.focus("#scene");
      await page.keyboard.press("f");
      await page.waitForSelector('#press-feels[aria-pressed="true"]');
      expect(await drag()).toBe(true);
      await page.keyboard.press("f");
      await page.waitForSelector('#press-feels[aria-pressed="false"]');
      await page.keyboard.press("Home");
    },
    PATIENCE_MS,
  );

  it(
    "is felt: a long press on the part is pushed back",
    async () => {
      const box = (await page.locator("#stage").boundingBox())!;
      await feelAt(page, box.x + 0.5 * box.width, box.y + 0.62 * box.height);
      await page.mouse.move(box.x + 0.51 * box.width, box.y + 0.62 * box.height, { steps: 4 });
      await page.waitForFunction(() => parseFloat(document.getElementById("felt")?.textContent ?? "0") > 0.05, null, {
        timeout: PATIENCE_MS,
      });
      await picture("finger");
      await page.mouse.up();
      await page.click("#show-panel");
      await page.waitForSelector("#felt-row", { state: "hidden", timeout: PATIENCE_MS });
      await page.click("#stop");
      await until("Release", "stop");
      await page.click("#stop");
      await until("Stop", "stop");
      await page.click("#force-on");
      await page.waitForSelector('#force-on[aria-pressed="false"]');
      await page.click("#force-on");
      await page.selectOption("#mode", "inspect");
      await page.selectOption("#mode", "cut");
    },
    PATIENCE_MS,
  );

  it(
    "recuts with other settings",
    async () => {
      const peak = async () => parseFloat(await text("peak"));
      await page.fill("#time", "1.2");
      await page.waitForFunction(() => parseFloat(document.getElementById("peak")?.textContent ?? "0") > 20, null, {
        timeout: PATIENCE_MS,
      });
      const before = await peak();
      await page.selectOption("#material", "ti6al4v");
      await page.waitForFunction(
        (n) => parseFloat(document.getElementById("peak")?.textContent ?? "0") > 1.3 * n,
        before,
        { timeout: PATIENCE_MS },
      );
      for (const key of ["feed_percent", "spindle_percent", "helix_deg", "force_scale", "jnd"]) {
        await page.focus(`#set-${key}`);
        await page.keyboard.press("Home");
      }
      await until("10 %", "parameters");
      await page.selectOption("#material", "al7075-t6");
    },
    PATIENCE_MS,
  );

  it(
    "looks different as it is told",
    async () => {
      const boxes = ["show-tool", "show-positions", "show-arrow"];
      for (const id of boxes) await page.click(`#${id}`);
      for (const [id, values] of [
        ["palette", ["paper", "safe", "metal"]],
        ["look", ["fine", "plain", "auto"]],
        ["passes", ["all", "none", "pass"]],
      ] as const) {
        for (const value of values) await page.selectOption(`#${id}`, value);
      }
      for (const theme of ["dark", "light"]) {
        await page.selectOption("#theme", theme);
        expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe(theme);
      }
      for (const id of boxes) await page.click(`#${id}`);
      for (const by of ["force", "chip"]) {
        await page.selectOption("#colouring", by);
        expect(await page.isVisible("#legend")).toBe(true);
        await page.waitForTimeout(500);
        await picture(`colour-${by}`);
      }
      // The value under the pointer, wherever it meets the slot.
      const box = (await page.locator("#stage").boundingBox())!;
      let said = "";
      for (let n = 0; n < 60 && !/chip \d/.test(said); ++n) {
        await page.mouse.move(
          box.x + (0.25 + 0.02 * (n % 20)) * box.width,
          box.y + (0.45 + 0.1 * Math.floor(n / 20)) * box.height,
        );
        said = await text("pointed");
      }
      expect(said).toMatch(/^chip \d\.\d{3} mm.*, line \d+$/);
      await until("rubs", "legend-marks");
      await page.selectOption("#colouring", "deviation");
      await until("no designed surface", "notice");
      await page.selectOption("#colouring", "plain");
      await page.click("#fit");
    },
    PATIENCE_MS,
  );

  it(
    "measures between two places",
    async () => {
      await page.click("#measure");
      const box = (await page.locator("#stage").boundingBox())!;
      await page.mouse.click(box.x + 0.45 * box.width, box.y + 0.62 * box.height);
      await page.mouse.click(box.x + 0.55 * box.width, box.y + 0.62 * box.height);
      await page.waitForFunction(() => /^\d+\.\d{2} mm/.test(document.getElementById("measured")?.textContent ?? ""));
      const length = parseFloat(await text("measured"));
      expect(length).toBeGreaterThan(0.5);
      expect(length).toBeLessThan(35);
      await page.click("#measure");
      expect(await page.isVisible("#measured")).toBe(false);
    },
    PATIENCE_MS,
  );

  it(
    "plots force, turn, spectrum, engagement and sound when asked",
    async () => {
      await page.click("#show-plots");
      for (const tab of ["force", "one-turn", "spectrum", "engagement", "sound"]) {
        await page.click(`#tab-${tab}`);
        await page.waitForSelector("#plot-panel canvas");
        const colours = () =>
          page.evaluate(() => {
            const canvas = document.querySelector<HTMLCanvasElement>("#plot-panel canvas")!;
            const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
            return new Set(data).size;
          });
        await expect.poll(colours, { timeout: PATIENCE_MS }).toBeGreaterThan(4);
        await picture(`plot-${tab}`);
      }
      await page.focus("#tab-sound");
      await page.keyboard.press("ArrowRight");
      expect(await page.getAttribute("#tab-force", "aria-selected")).toBe("true");
      // An open plot follows the theme: its text is light in the dark.
      const brightness = () =>
        page.evaluate(() => {
          const canvas = document.querySelector<HTMLCanvasElement>("#plot-panel canvas")!;
          const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
          let most = 0;
          for (let n = 0; n < data.length; n += 4)
            if (data[n + 3]! > 100) most = Math.max(most, Math.min(data[n]!, data[n + 1]!, data[n + 2]!));
          return most;
        });
      const inLight = await brightness();
      const wait = { timeout: 15_000 };
      await page.selectOption("#theme", "dark");
      await expect.poll(brightness, wait).toBeGreaterThan(inLight);
      await page.selectOption("#theme", "light");
      await expect.poll(brightness, wait).toBe(inLight);
      // And that of the device, where the page has none of its own.
      await page.selectOption("#theme", "");
      await page.emulateMedia({ colorScheme: "dark" });
      await expect.poll(brightness, wait).toBeGreaterThan(inLight);
      await page.emulateMedia({ colorScheme: "light" });
      await expect.poll(brightness, wait).toBe(inLight);
      await page.selectOption("#theme", "light");
      await page.click("#show-plots");
    },
    PATIENCE_MS,
  );

  it(
    "is worked by keys",
    async () => {
      await page.focus("#scene");
      for (const key of ["ArrowLeft", "ArrowUp", "+", "-", "Home", "m", "m"]) await page.keyboard.press(key);
      await page.keyboard.press("Space");
      await until("Pause", "play");
      await page.keyboard.press("Space");
      await until("Play", "play");
      await page.keyboard.down("Shift");
      await page.keyboard.press("ArrowRight");
      await page.waitForSelector("#felt-row", { state: "visible", timeout: PATIENCE_MS });
      await page.keyboard.up("Shift");
      await page.waitForSelector("#felt-row", { state: "hidden", timeout: PATIENCE_MS });
    },
    PATIENCE_MS,
  );

  it(
    "plays a cut again and again",
    async () => {
      await load(file("job.toml", JOB), file("p.nc", PROGRAM));
      await page.selectOption("#speed", "1");
      await page.fill("#time", "1.2");
      await removed(0.05);
      await page.focus("#scene");
      await page.keyboard.press("l");
      expect(await page.getAttribute("#loop", "aria-pressed")).toBe("true");
      await page.selectOption("#speed", "5");
      await page.click("#play");
      // The slot ends at 2 s, the second one begins later.
      await page.waitForFunction(
        () => {
          const seen = window as unknown as { times?: number[] };
          const times = (seen.times ??= []);
          times.push(Number(document.querySelector<HTMLInputElement>("#time")!.value));
          return times.filter((time, n) => time < times[n - 1]! - 0.5).length >= 3;
        },
        null,
        { timeout: PATIENCE_MS },
      );
      const times = await page.evaluate(() => (window as unknown as { times: number[] }).times);
      expect(Math.max(...times)).toBeLessThan(3.5);
      await page.click("#loop");
      await page.selectOption("#speed", "1");
      await page.click("#play");
      await until("Play", "play");
    },
    PATIENCE_MS,
  );

  it(
    "runs through air faster and faster, and as chosen in the cut",
    async () => {
      // Half a minute of air, then a cut.
      const air = "G21 G90\nG0 X-8 Y8 Z5\nG1 X22 F60\nZ-1 F600\nX35 F12\nM30\n";
      await load(file("job.toml", JOB), file("p.nc", air));
      await page.selectOption("#speed", "1");
      await page.click("#skip-air");
      expect(await page.getAttribute("#skip-air", "aria-pressed")).toBe("true");
      const now = () => page.inputValue("#time").then(Number);
      const began = Date.now();
      await page.click("#begin");
      await page.waitForFunction(() => Number((document.getElementById("time") as HTMLInputElement).value) > 25, null, {
        timeout: PATIENCE_MS,
      });
      expect(Date.now() - began).toBeLessThan(20_000);
      await removed(0.02);
      const speed = async () => {
        const [from, at] = [await now(), Date.now()];
        await page.waitForTimeout(1000);
        return (1000 * ((await now()) - from)) / (Date.now() - at);
      };
      // A busy machine takes a while to slow down.
      await expect.poll(async () => Math.abs((await speed()) - 1), { timeout: PATIENCE_MS }).toBeLessThan(0.6);
      await page.click("#play");
      await until("Play", "play");
      await page.click("#skip-air");
      await load(file("job.toml", JOB), file("p.nc", PROGRAM));
      await until("4G1 X35", "program-line-4");
      await page.fill("#time", "1000");
      await page.waitForSelector("#next-problem:not([hidden])", { timeout: PATIENCE_MS });
    },
    PATIENCE_MS,
  );

  it(
    "goes to the next problem, and shows its keys",
    async () => {
      await page.waitForSelector("#next-problem:not([hidden])", { timeout: PATIENCE_MS });
      // After the last problem comes the first.
      const end = Number(await page.getAttribute("#time", "max"));
      await expect
        .poll(() => page.inputValue("#time").then(Number), { timeout: PATIENCE_MS })
        .toBeGreaterThan(end - 1e-6);
      await page.focus("#scene");
      // The clock may be ahead of the mill: the problem is found when it is milled.
      const next = async () => {
        await page.keyboard.press("n");
        return Number(await page.inputValue("#time"));
      };
      await expect.poll(next, { timeout: PATIENCE_MS }).toBeLessThan(end - 0.01);
      await page.fill("#time", "1000");
      await page.keyboard.press("?");
      await page.waitForSelector("#keys[open]");
      expect(await violations(page)).toEqual([]);
      await picture("keys");
      await page.keyboard.press("Escape");
      await page.waitForSelector("#keys", { state: "hidden" });
    },
    PATIENCE_MS,
  );

  it(
    "opens every example of the site",
    async () => {
      const visitor = await browser.newPage({ viewport: { width: 1000, height: 700 }, reducedMotion: "reduce" });
      mill.watch(visitor);
      const pictures: number[] = [];
      visitor.on("response", async (response) => {
        if (response.url().endsWith(".webp")) pictures.push((await response.body()).length);
      });
      await visitor.goto(`${server.root}/mill/`);
      await visitor.waitForSelector("#examples:not([hidden])", { timeout: PATIENCE_MS });
      expect(pictures).toEqual([]);
      for (const { job, name } of EXAMPLES) {
        await visitor.click("#examples");
        const card = visitor.locator(`#gallery-examples button[data-job="${job}"]`);
        expect(await card.textContent()).toContain(name);
        await card.scrollIntoViewIfNeeded();
        await expect
          .poll(() => card.locator("img").evaluate((image: HTMLImageElement) => image.naturalWidth), {
            timeout: PATIENCE_MS,
          })
          .toBe(WIDE);
        await card.click();
        await visitor.waitForFunction((want) => document.getElementById("job")?.textContent === want, job, {
          timeout: PATIENCE_MS,
        });
        await visitor.waitForSelector("#program-lines [data-line]", { timeout: PATIENCE_MS });
        expect(await visitor.isVisible("#notice-box")).toBe(false);
      }
      // A few kB each.
      expect(Math.max(...pictures)).toBeLessThan(16_000);
      await visitor.close();
    },
    4 * PATIENCE_MS,
  );

  it(
    "shows the examples to those who do not see, and on a phone",
    async () => {
      const visitor = await browser.newPage({ viewport: { width: 390, height: 844 }, reducedMotion: "reduce" });
      mill.watch(visitor);
      await visitor.goto(`${server.root}/mill/`);
      await visitor.waitForSelector("#examples:not([hidden])", { timeout: PATIENCE_MS });
      await visitor.focus("#examples");
      await visitor.keyboard.press("Enter");
      await visitor.waitForSelector("#gallery[open]");
      expect(await violations(visitor)).toEqual([]);
      expect(await visitor.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
      await visitor.keyboard.press("Tab");
      expect(await visitor.evaluate(() => document.activeElement?.getAttribute("data-job"))).toBe("bowl.toml");
      await visitor.keyboard.press("Escape");
      await visitor.waitForSelector("#gallery", { state: "hidden" });
      await visitor.close();
    },
    PATIENCE_MS,
  );

  it(
    "is free of what axe finds, light and dark, wide and on a phone",
    async () => {
      for (const theme of ["light", "dark"]) {
        await page.selectOption("#theme", theme);
        expect(await violations(page)).toEqual([]);
      }
      await picture("dark");
      await page.setViewportSize({ width: 390, height: 844 });
      await page.waitForTimeout(300);
      await picture("phone-panel");
      await page.click("#show-panel");
      await page.click("#show-program");
      await page.waitForSelector("#program-lines [data-line]");
      expect(await page.isVisible("#program")).toBe(true);
      expect(await violations(page)).toEqual([]);
      await picture("phone-program");
      await page.click("#show-program");
      expect(await page.isVisible("#program")).toBe(false);
      await page.waitForTimeout(300);
      await picture("phone");
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      expect(wide).toBeLessThanOrEqual(390);
      for (const id of ["play", "open", "show-panel", "time"]) {
        const box = (await page.locator(`#${id}`).boundingBox())!;
        expect(box.x).toBeGreaterThanOrEqual(0);
        expect(box.x + box.width).toBeLessThanOrEqual(390);
        expect(box.y + box.height).toBeLessThanOrEqual(844);
      }
    },
    PATIENCE_MS,
  );

  it("asks nobody else and makes no error", () => {
    expect(foreign).toEqual([]);
    expect(problems).toEqual([]);
  });
});

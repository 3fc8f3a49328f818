// SPDX-License-Identifier: MIT
// The example of docs/touch.md, word for word; the site's page; the package as npm would publish it.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { hasBrowser, launch } from "../../testing/browser.js";
import { COMPONENT, ROOT } from "../../tools/places.js";
import type { TriboTouch } from "../src/element.js";
import { violations } from "../../testing/axe.js";
import { muddled, material, png, serve, servePage, type Site } from "./site.js";

let site: Site;
let browser: Browser;
beforeAll(async () => {
  site = await serve();
  if (hasBrowser) browser = await launch();
});
afterAll(async () => {
  await browser?.close();
  await site.close();
});

test.skipIf(!hasBrowser)("the five lines of the documentation give a touchable carpet", async () => {
  const text = await readFile(join(ROOT, "docs/touch.md"), "utf8");
  const [, example = ""] = /```html\n([^]*?)```/.exec(text) ?? [];
  expect(example.trim().split("\n").length).toBe(5);
  for (const file of ["tribo-touch.js", "worklet.js", "touch.wasm"]) {
    site.pages.set(`/${file}`, await readFile(join(COMPONENT, file)));
  }
  site.pages.set("/example.html", example);
  site.pages.set(
    "/carpet.jpg",
    png(64, 48, () => [90, 90, 90]),
  );
  site.pages.set("/carpet.json", JSON.stringify(material({ name: "carpet", image: "carpet.jpg" })));
  site.requests.length = 0;
  const page = await browser.newPage();
  await page.goto(`${site.root}/example.html`);
  await page.waitForFunction(() => document.querySelector<TriboTouch>("tribo-touch")?.state === "ready");
  expect(await page.evaluate(() => document.querySelector<TriboTouch>("tribo-touch")?.material?.name)).toBe("carpet");
  // The poster is the material's image: fetched before the material is there, and only once.
  expect(site.requests.filter((path) => path === "/carpet.jpg")).toHaveLength(1);
  await page.close();
});

test("the packed package installs from its tarball, imports on a server and knows its types", async () => {
  const folder = await mkdtemp(join(tmpdir(), "tribo-pack-"));
  try {
    const here = new URL("..", import.meta.url).pathname;
    const name = execFileSync("npm", ["pack", "--silent", "--pack-destination", folder], {
      cwd: here,
      encoding: "utf8",
    })
      .trim()
      .split("\n")
      .at(-1)!;
    execFileSync("npm", ["init", "--yes", "--silent"], { cwd: folder });
    execFileSync("npm", ["install", "--silent", "--no-audit", "--no-fund", "--offline", join(folder, name)], {
      cwd: folder,
    });
    const installed = JSON.parse(await readFile(join(folder, "node_modules/@tribo/touch/package.json"), "utf8"));
    expect(installed.dependencies).toBeUndefined();
    for (const file of [
      "dist/tribo-touch.js",
      "dist/worklet.js",
      "dist/touch.wasm",
      "dist/types/index.d.ts",
      "custom-elements.json",
    ]) {
      expect((await readFile(join(folder, "node_modules/@tribo/touch", file))).length).toBeGreaterThan(100);
    }
    const said = execFileSync(
      process.execPath,
      ["--input-type=module", "-e", 'import { TriboTouch } from "@tribo/touch"; console.log(typeof TriboTouch)'],
      { cwd: folder, encoding: "utf8" },
    );
    expect(said.trim()).toBe("function");
    await writeFile(
      join(folder, "user.ts"),
      'import { TriboTouch, type ContactDetail } from "@tribo/touch";\nexport const depth = (_: TriboTouch, { depth_mm }: ContactDetail): number => depth_mm;\n',
    );
    const compiler = join(dirname(createRequire(import.meta.url).resolve("typescript/package.json")), "bin/tsc");
    const flags = [
      "--noEmit",
      "--strict",
      "--target",
      "es2022",
      "--module",
      "esnext",
      "--moduleResolution",
      "bundler",
      "--types",
      "",
    ];
    expect(spawnSync(process.execPath, [compiler, ...flags, "user.ts"], { cwd: folder, encoding: "utf8" }).stdout).toBe(
      "",
    );
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
});

test.skipIf(!hasBrowser)("the touch page turns K and nu of both models and passes axe-core", async () => {
  servePage(site);
  // So tall that all pictures are in view.
  const page = await browser.newPage({ viewport: { width: 900, height: 2600 } });
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (said) => {
    if (said.text().includes("Content Security Policy")) errors.push(said.text());
  });
  await page.goto(`${site.root}/site/index.html`);
  const ready = () =>
    page.waitForFunction(() =>
      [...document.querySelectorAll<TriboTouch>("tribo-touch[src]")].every((e) => e.state === "ready"),
    );
  await ready();
  await page.waitForFunction(() => document.getElementById("stiffness-value")?.textContent === "1.40 N/mm");
  await page.getByText("Paper", { exact: true }).click();
  await page.waitForFunction(() => document.getElementById("stiffness-value")?.textContent === "7.00 N/mm");
  await ready();
  await page.locator("#stiffness").fill("0");
  expect(
    await page.evaluate(() =>
      ["#ours", "#model", "#published"].map((id) => document.querySelector<TriboTouch>(id)?.stiffness),
    ),
  ).toEqual([1, 1, 1]);
  expect(await page.locator("#meaning").textContent()).toContain("2 mm deep; 63 % of the way takes 300 ms");
  await page.locator("#own summary").click();
  await page.waitForFunction(() => document.querySelector<HTMLFormElement>("#make")?.noValidate);
  expect(await violations(page)).toEqual([]);
  if (process.env.TRIBO_SHOTS) await page.screenshot({ path: `${process.env.TRIBO_SHOTS}/page.png`, fullPage: true });
  expect(errors).toEqual([]);
  await page.close();
});

test.skipIf(!hasBrowser)(
  "the touch page shows a material from edge to edge, and the science one scroll below",
  async () => {
    servePage(site);
    for (const [width, height] of [
      [1440, 900],
      [1280, 720],
      [820, 1180],
      [390, 844],
    ] as const) {
      const page = await browser.newPage({ viewport: { width, height } });
      await page.goto(`${site.root}/site/index.html`);
      await page.waitForFunction(() => document.querySelector<TriboTouch>("#ours")?.state === "ready");
      const seen = await page.evaluate(() => {
        const place = (selector: string) => document.querySelector(selector)!.getBoundingClientRect();
        return {
          wide: document.documentElement.scrollWidth,
          stage: [place(".stage").left, place(".stage").right],
          sentence: place("#says").bottom,
          science: place("#science").top,
        };
      });
      expect(seen.wide).toBe(width);
      expect(seen.stage).toEqual([0, width]);
      expect(seen.sentence).toBeLessThan(height);
      expect(seen.science).toBeLessThan(1.1 * height);
      // A press in the middle of the stage meets the picture, whose top is above the stage.
      await page.evaluate(() =>
        document.addEventListener("contact-start", (event) =>
          Object.assign(window, { at: (event as CustomEvent<{ u: number; v: number }>).detail }),
        ),
      );
      const stage = (await page.locator(".stage").boundingBox())!;
      await page.mouse.move(stage.x + 0.5 * stage.width, stage.y + 0.5 * stage.height);
      await page.mouse.down();
      const at = await page.evaluate(() => (window as unknown as { at: { u: number; v: number } }).at);
      expect(at.u).toBeCloseTo(0.5, 1);
      expect(at.v).toBeCloseTo(0.5, 1);
      await page.close();
    }
  },
);

test.skipIf(!hasBrowser)("the touch page says what keeps a material silent", async () => {
  servePage(site);
  site.pages.set("/site/a.json", JSON.stringify(muddled()));
  const page = await browser.newPage();
  await page.goto(`${site.root}/site/index.html`);
  const said = (words: string) =>
    page.waitForFunction((wanted) => document.getElementById("wrong")?.textContent === wanted, words);
  await said("voices: speed_mm_per_s does not rise");
  await page.getByText("Paper", { exact: true }).click();
  await said("");
  await page.close();
});

// SPDX-License-Identifier: MIT
// The shader against src/elastic/picture.cpp: both draw the picture of tests/elastic/pressed.ppm (finish_test.cpp).
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { hasBrowser, launch } from "../../testing/browser.js";
import { bundle } from "../../tools/bundle.js";
import { ROOT } from "../../tools/places.js";
import type * as Parts from "./parts.js";
import { png, serve, type Rgb, type Site } from "./site.js";

declare global {
  interface Window {
    parts: typeof Parts;
  }
}

const kSide = 64;
const striped = (x: number, y: number): Rgb => {
  const stripe = 6 * Math.abs(((x + y) % 20) - 10);
  return [90 + stripe + x, 60 + stripe + y, 40 + stripe];
};
let site: Site;
let browser: Browser;
let page: Page;
let folder: string;

beforeAll(async () => {
  if (!hasBrowser) return;
  site = await serve();
  folder = await mkdtemp(join(tmpdir(), "tribo-parts-"));
  const file = join(folder, "parts.js");
  await bundle({ entry: join(import.meta.dirname, "parts.ts"), file });
  // Beside touch.wasm, where the engine looks for it.
  site.pages.set("/dist/parts.js", await readFile(file));
  site.pages.set("/striped.png", png(kSide, kSide, striped));
  site.page(
    "/",
    '<canvas width="64" height="64"></canvas><script type="module">import * as parts from "/dist/parts.js"; window.parts = parts;</script>',
  );
  browser = await launch();
  page = await browser.newPage();
  await page.goto(`${site.root}/`);
  await page.waitForFunction(() => window.parts !== undefined);
});
afterAll(async () => {
  await browser?.close();
  await site?.close();
  if (folder) await rm(folder, { recursive: true });
});

type Finish = Parts.Picture["finish"];
/** RGBA of the picture; of one at rest where nothing presses. */
const drawn = (finish: Finish, force: number) =>
  page.evaluate(
    async ({ side, how, newton }) => {
      const { engine, renderer, pixelsOf } = window.parts;
      const made = await engine();
      const image = new Image();
      image.src = "/striped.png";
      await image.decode();
      const sheet = made.sheet(side, side, 0.5);
      const picture: Parts.Picture = { image, nodesX: side, nodesY: side, spacingMm: 0.5, finish: how };
      if (how !== undefined) {
        picture.relief = pixelsOf(image, side, side);
        made.smallRelief(picture.relief, 0.2);
      }
      sheet.setMaterial(2, 0);
      const finger = { x: 14, y: 17, halfWidth: 4, halfHeight: 4, force: newton, held: 0 };
      sheet.press([{ ...finger, x: 24, dx: 6, dy: -4 }], false, false, newton > 0);
      sheet.press([finger], false);
      sheet.step(1, false);
      const context = document.querySelector("canvas")!.getContext("2d")!;
      renderer().add(picture);
      renderer().upload(picture, sheet.everything());
      const leans = sheet.leans();
      if (leans !== null) renderer().lean(picture, leans);
      renderer().draw(picture, context, true, 1);
      renderer().free(picture);
      sheet.free();
      return [...context.getImageData(0, 0, side, side).data];
    },
    { side: kSide, how: finish, newton: force },
  );
const kFinish: Finish = { gloss: 0.1, roughness: 0.3, pile: 0.5 };

test.skipIf(!hasBrowser)("the shader draws the picture that picture.cpp draws", async () => {
  const file = await readFile(join(ROOT, "tests/elastic/pressed.ppm"));
  const expected = file.subarray(file.length - 3 * kSide * kSide);
  const pixels = await drawn(kFinish, 1);
  let most = 0;
  let sum = 0;
  let moved = 0;
  for (let i = 0; i < kSide * kSide; ++i) {
    const flat = striped(i % kSide, Math.floor(i / kSide));
    for (const c of [0, 1, 2] as const) {
      const away = Math.abs(pixels[4 * i + c]! - expected[3 * i + c]!);
      most = Math.max(most, away);
      sum += away;
      moved += Math.abs(flat[c] - expected[3 * i + c]!);
    }
  }
  // The picture is far from flat; graphics hardware interpolates with eight bits, and rounds where it likes.
  expect(moved / (3 * kSide * kSide)).toBeGreaterThan(5);
  expect(sum / (3 * kSide * kSide)).toBeLessThan(0.2);
  expect(most).toBeLessThanOrEqual(8);
});

test.skipIf(!hasBrowser).each<[string, Finish]>([
  ["lit", kFinish],
  ["published", undefined],
])("at rest a %s picture is the image byte by byte", async (_, finish) => {
  const pixels = await drawn(finish, 0);
  for (let i = 0; i < kSide * kSide; ++i) {
    expect(pixels.slice(4 * i, 4 * i + 3)).toEqual(striped(i % kSide, Math.floor(i / kSide)));
  }
});

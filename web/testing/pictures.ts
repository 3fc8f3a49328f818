// SPDX-License-Identifier: MIT
// Pictures of a page that are compared with small stored ones. Both are averaged down to the same size, so that the grain of
// an edge does not count and an area does. TRIBO_STORE_PICTURES=1 stores them anew: look at them before they are kept.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import type { Page } from "playwright-core";

const WIDTH = 120;
// Levels of 255 that two builds of a browser may differ by.
const SAME_LEVELS = 8;

export interface Clip {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** What is seen, averaged down, as a PNG. */
export async function small(page: Page, clip: Clip): Promise<Buffer> {
  const whole = (await page.screenshot({ clip })).toString("base64");
  const height = Math.round((WIDTH * clip.height) / clip.width);
  const url = await page.evaluate(
    async ([png, wide, high]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      // By halves: each step averages four pixels.
      let from: HTMLImageElement | HTMLCanvasElement = image;
      for (let width = image.naturalWidth; ;) {
        const next = Math.max(Math.ceil(width / 2), wide);
        const canvas = document.createElement("canvas");
        canvas.width = next;
        canvas.height = next === wide ? high : Math.round((next * image.naturalHeight) / image.naturalWidth);
        const c = canvas.getContext("2d")!;
        c.imageSmoothingQuality = "high";
        c.drawImage(from, 0, 0, canvas.width, canvas.height);
        from = canvas;
        width = next;
        if (next === wide) return canvas.toDataURL("image/png");
      }
    },
    [whole, WIDTH, height] as const,
  );
  return Buffer.from(url.split(",")[1]!, "base64");
}

/** The share of the pixels in which two PNGs of one size differ by more than SAME_LEVELS; 1 where the sizes differ. */
export async function differing(page: Page, a: Buffer, b: Buffer): Promise<number> {
  const [x, y] = [await decoded(page, a), await decoded(page, b)];
  if (x.width !== y.width || x.data.length !== y.data.length) return 1;
  let off = 0;
  for (let n = 0; n < x.data.length; n += 4)
    if ([0, 1, 2].some((k) => Math.abs(x.data[n + k]! - y.data[n + k]!) > SAME_LEVELS)) ++off;
  return off / (x.data.length / 4);
}

/** The pixels of a PNG, four bytes each, by the page that has a decoder. */
async function decoded(page: Page, png: Buffer): Promise<{ width: number; data: Buffer }> {
  const { width, bytes } = await page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    const c = canvas.getContext("2d")!;
    c.drawImage(image, 0, 0);
    const { data } = c.getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let n = 0; n < data.length; n += 8192) text += String.fromCharCode(...data.subarray(n, n + 8192));
    return { width: canvas.width, bytes: btoa(text) };
  }, png.toString("base64"));
  return { width, data: Buffer.from(bytes, "base64") };
}

// Levels of 255: the light ground is lighter, a part and a tool in the plain light are darker.
const DARK = 195;
// A red mark has so much more red than green and blue.
const RED = 60;

/** The share of the pixels of the page that a part or a tool covers, in the light theme. */
export function darkShare(page: Page, clip: Clip): Promise<number> {
  return share(page, clip, (r, g, b) => Math.max(r, g, b) < DARK);
}
/** The share of the pixels of the page that are red. */
export function redShare(page: Page, clip: Clip): Promise<number> {
  return share(page, clip, (r, g, b) => r - Math.max(g, b) > RED);
}

async function share(page: Page, clip: Clip, counts: (r: number, g: number, b: number) => boolean): Promise<number> {
  const { data } = await decoded(page, await page.screenshot({ clip }));
  let count = 0;
  for (let n = 0; n < data.length; n += 4) if (counts(data[n]!, data[n + 1]!, data[n + 2]!)) ++count;
  return count / (data.length / 4);
}

/** The stored picture. With TRIBO_STORE_PICTURES, `now` is stored first. */
export function stored(path: string, now: Buffer): Buffer {
  if (process.env.TRIBO_STORE_PICTURES && now.length > 0) {
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, now);
  }
  if (!existsSync(path)) throw new Error(`${path} is not there: run once with TRIBO_STORE_PICTURES=1 and look at it`);
  return readFileSync(path);
}

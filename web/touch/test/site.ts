// SPDX-License-Identifier: MIT
// What the browser tests serve: the built component, made-up materials, pages. No network but localhost.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import { serve as serveBodies, type Body } from "../../testing/server.js";
import { COMPONENT, SITE } from "../../tools/places.js";

export type Rgb = [number, number, number];

function chunk(type: string, data: Buffer): Buffer {
  const bytes = Buffer.alloc(12 + data.length);
  bytes.writeUInt32BE(data.length, 0);
  bytes.write(type, 4, "latin1");
  data.copy(bytes, 8);
  let crc = ~0;
  for (const byte of bytes.subarray(4, 8 + data.length)) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  bytes.writeUInt32BE(~crc >>> 0, 8 + data.length);
  return bytes;
}

export function png(width: number, height: number, colour: (x: number, y: number) => Rgb): Buffer {
  const rows = Buffer.alloc(height * (1 + 3 * width));
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) rows.set(colour(x, y), y * (1 + 3 * width) + 1 + 3 * x);
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([
    Buffer.from("89504e470d0a1a0a", "hex"),
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

const checker =
  (size: number) =>
  (x: number, y: number): Rgb =>
    ((x / size) ^ (y / size)) & 1 ? [190, 140, 70] : [230, 200, 130];

const voice = (speed: number) => ({
  speed_mm_per_s: speed,
  level_db: -22,
  sample_rate_hz: 44100,
  reflection: [-0.6, 0.2],
});

/** A material file, with what a test wants otherwise. */
export function material(changes: object = {}): object {
  return {
    schema: "tribo.material/1",
    name: "sponge",
    stiffness_n_per_mm: 1.4,
    viscosity_n_s_per_mm: 0.1,
    width_mm: 80,
    image: "sponge.png",
    method: "yule-walker",
    highpass_hz: 50,
    level_law: { level_db: -20, db_per_decade_speed: 10, db_per_decade_force: 10 },
    voices: [50, 150].map(voice),
    ...changes,
  };
}

/** Whose voices do not rise. */
export const muddled = () => material({ voices: [150, 50].map(voice) });

const made: Record<string, () => Body> = {
  "/sponge.png": () => png(256, 192, checker(16)),
  "/plain.png": () => png(96, 96, () => [120, 120, 120]),
  "/halves.png": () => png(64, 48, (x) => (x < 32 ? [255, 255, 255] : [0, 0, 0])),
  "/sponge.json": () => JSON.stringify(material()),
  "/plain.json": () => JSON.stringify(material({ image: "plain.png", voices: [] })),
  "/velvet.json": () => JSON.stringify(material({ image: "plain.png", voices: [], pile: 0.6 })),
  "/mapped.json": () => JSON.stringify(material({ image: "plain.png", height_map: "ridges.png", voices: [] })),
  "/mismapped.json": () => JSON.stringify(material({ height_map: "ridges.png" })),
  "/ridges.png": () => png(96, 96, (x) => (x % 8 < 4 ? [255, 255, 255] : [0, 0, 0])),
  "/broken.json": () => '{"schema": "tribo.material/1", "stiffness_n_per_mm": "soft"}',
  "/muddled.json": () => JSON.stringify(muddled()),
  "/noimage.json": () => JSON.stringify(material({ image: "gone.png" })),
};

/** The built touch page under /site/, without its materials. */
export function servePage(site: Site): void {
  for (const file of [
    "index.html",
    "touch.css",
    "page.js",
    "make.js",
    "learner.js",
    "learn.wasm",
    "tribo-touch.js",
    "worklet.js",
    "touch.wasm",
  ]) {
    site.pages.set(`/site/${file}`, readFileSync(join(SITE, file)));
  }
  site.pages.set(
    "/site/materials.json",
    JSON.stringify([
      { file: "a.json", name: "Sponge", note: "made up" },
      { file: "b.json", name: "Paper", note: "" },
    ]),
  );
  site.pages.set("/site/a.json", JSON.stringify(material()));
  site.pages.set(
    "/site/b.json",
    JSON.stringify(material({ name: "Paper", stiffness_n_per_mm: 7, viscosity_n_s_per_mm: 0.3 })),
  );
  site.pages.set(
    "/site/sponge.png",
    png(320, 240, (x, y) => [200 + (x % 16), 180, 120 + (y % 16)]),
  );
}

export interface Site {
  root: string;
  /** Paths that answer 404 as long as they are in it. */
  blocked: Set<string>;
  /** What lies where, besides the component under /dist/ and the made-up materials. */
  pages: Map<string, Body>;
  requests: string[];
  page(path: string, body: string): void;
  close(): Promise<void>;
}

export async function serve(): Promise<Site> {
  const blocked = new Set<string>();
  const pages = new Map<string, Body>();
  const requests: string[] = [];
  const packed = (path: string) => {
    const file = join(COMPONENT, path.slice("/dist/".length));
    return path.startsWith("/dist/") && existsSync(file) ? readFileSync(file) : undefined;
  };
  const { root, close } = await serveBodies((path) => {
    requests.push(path);
    return blocked.has(path) ? undefined : (pages.get(path) ?? made[path]?.() ?? packed(path));
  });
  const page = (path: string, body: string) =>
    pages.set(path, `<!doctype html><html lang="en"><meta charset="utf-8"><title>t</title><body>${body}`);
  return { root, blocked, pages, requests, page, close };
}

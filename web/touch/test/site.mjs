// SPDX-License-Identifier: MIT
// What the browser tests serve: the built component, made-up materials, pages. No network but localhost.
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname } from "node:path";
import { deflateSync } from "node:zlib";

const kTypes = { ".js": "text/javascript", ".wasm": "application/wasm", ".json": "application/json", ".png": "image/png",
  ".html": "text/html", ".jpg": "image/jpeg", ".css": "text/css" };
const dist = new URL("../dist/", import.meta.url).pathname;

function chunk(type, data) {
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

/** A PNG of colour(x, y) = [r, g, b]. */
export function png(width, height, colour) {
  const rows = Buffer.alloc(height * (1 + 3 * width));
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) rows.set(colour(x, y), y * (1 + 3 * width) + 1 + 3 * x);
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from("89504e470d0a1a0a", "hex"), chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))]);
}

const checker = (size) => (x, y) => ((x / size) ^ (y / size)) & 1 ? [190, 140, 70] : [230, 200, 130];

export function material(changes = {}) {
  return {
    schema: "tribo.material/1", name: "sponge", stiffness_n_per_mm: 1.4, viscosity_n_s_per_mm: 0.1, width_mm: 80, image: "sponge.png",
    method: "yule-walker", highpass_hz: 50, level_law: { level_db: -20, db_per_decade_speed: 10, db_per_decade_force: 10 },
    voices: [50, 150].map((speed) => ({ speed_mm_per_s: speed, level_db: -22, sample_rate_hz: 44100, reflection: [-0.6, 0.2] })),
    ...changes,
  };
}

const made = {
  "/sponge.png": () => png(256, 192, checker(16)),
  "/plain.png": () => png(96, 96, () => [120, 120, 120]),
  "/halves.png": () => png(64, 48, (x) => (x < 32 ? [255, 255, 255] : [0, 0, 0])),
  "/sponge.json": () => JSON.stringify(material()),
  "/plain.json": () => JSON.stringify(material({ image: "plain.png", voices: [] })),
  "/mapped.json": () => JSON.stringify(material({ image: "plain.png", height_map: "ridges.png", voices: [] })),
  "/mismapped.json": () => JSON.stringify(material({ height_map: "ridges.png" })),
  "/ridges.png": () => png(96, 96, (x) => (x % 8 < 4 ? [255, 255, 255] : [0, 0, 0])),
  "/broken.json": () => '{"schema": "tribo.material/1", "stiffness_n_per_mm": "soft"}',
  "/noimage.json": () => JSON.stringify(material({ image: "gone.png" })),
};

/** The built touch page under /site/, without its materials. */
export async function servePage(site) {
  const built = new URL("../../../build/web/site/", import.meta.url);
  for (const file of ["index.html", "touch.css", "page.js", "make.js", "learner.js", "learn.wasm", "tribo-touch.js", "worklet.js", "touch.wasm"]) {
    site.pages.set(`/site/${file}`, await readFile(new URL(file, built)));
  }
  site.pages.set("/site/materials.json", JSON.stringify([{ file: "a.json", name: "Sponge", note: "made up" }, { file: "b.json", name: "Paper", note: "" }]));
  site.pages.set("/site/a.json", JSON.stringify(material()));
  site.pages.set("/site/b.json", JSON.stringify(material({ name: "Paper", stiffness_n_per_mm: 7, viscosity_n_s_per_mm: 0.3 })));
  site.pages.set("/site/sponge.png", png(320, 240, (x, y) => [200 + (x % 16), 180, 120 + (y % 16)]));
}

/** Serves until close(); `blocked` is a set of paths that answer 404 as long as they are in it. */
export async function serve() {
  const blocked = new Set(), pages = new Map(), requests = [];
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, "http://localhost").pathname;
    requests.push(path);
    try {
      if (blocked.has(path)) throw new Error("blocked");
      const body = pages.get(path) ?? made[path]?.() ?? (path.startsWith("/dist/") ? await readFile(dist + path.slice(6)) : undefined);
      if (body === undefined) throw new Error("unknown");
      response.writeHead(200, { "Content-Type": kTypes[extname(path)] ?? "text/html" }).end(body);
    } catch {
      response.writeHead(404).end("not here");
    }
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return {
    blocked, pages, requests,
    root: `http://localhost:${server.address().port}`,
    page(path, body) { pages.set(path, `<!doctype html><html lang="en"><meta charset="utf-8"><title>t</title><body>${body}`); },
    close: () => new Promise((done) => { server.closeAllConnections(); server.close(done); }),
  };
}

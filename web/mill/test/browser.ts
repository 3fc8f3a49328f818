// SPDX-License-Identifier: MIT
// Headless Chromium, and a server of static files for it.
import { createServer, type Server } from "node:http";
import { existsSync, readFileSync, statSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";
import { chromium, type Browser } from "playwright-core";

export const ROOT = join(import.meta.dirname, "../../..");
export const PROGRAM = join(ROOT, "build/release/tribo");
export const CHROMIUM = "/usr/bin/chromium";
export const PATIENCE_MS = 60_000;

// A ball cutter in a block, by the program p.nc.
export function jobText(box_mm: string, more = ""): string {
  return `${more}[stock]
box_mm = ${box_mm}
[cutter]
kind = "ball"
diameter_mm = 6
flutes = 2
helix_deg = 30
length_mm = 20
[material]
name = "al7075-t6"
[process]
spindle_rpm = 9000
feed_mm_per_min = 1200
[path]
gcode = "p.nc"
`;
}

export function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: CHROMIUM,
    headless: true,
    args: [
      "--no-sandbox",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--autoplay-policy=no-user-gesture-required",
    ],
  });
}

const TYPES: Record<string, string> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".wasm": "application/wasm",
};

// Packs what it sends, as web servers do.
export function serve(folder: string): Promise<{ server: Server; url: string }> {
  const packed = new Map<string, Buffer>();
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url ?? "/", "http://x").pathname);
    const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
    if (!existsSync(file) || !statSync(file).isFile()) return void response.writeHead(404).end();
    if (!packed.has(file)) packed.set(file, gzipSync(readFileSync(file)));
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", "content-encoding": "gzip" });
    response.end(packed.get(file));
  });
  return new Promise((resolve) => {
    server.listen(0, "127.0.0.1", () => {
      const address = server.address();
      if (address === null || typeof address === "string") throw new Error("no port");
      resolve({ server, url: `http://127.0.0.1:${address.port}/` });
    });
  });
}

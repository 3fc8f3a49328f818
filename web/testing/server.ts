// SPDX-License-Identifier: MIT
// A web server on this machine for a browser under test. It packs what it sends, as web servers do.
import { existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";

const TYPES: Record<string, string> = {
  "": "text/html; charset=utf-8",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".wasm": "application/wasm",
  ".png": "image/png",
  ".jpg": "image/jpeg",
  ".webp": "image/webp",
};

export interface Server {
  /** http://localhost and a port, without a slash at the end. */
  root: string;
  close(): Promise<void>;
}

export type Body = string | Uint8Array;

/** Packed forms of bodies that are sent more than once. */
const packed = new WeakMap<Uint8Array, Uint8Array>();

function pack(body: Body): Uint8Array {
  const before = body instanceof Uint8Array ? packed.get(body) : undefined;
  if (before !== undefined) return before;
  const now = gzipSync(body, { level: 9 });
  if (body instanceof Uint8Array) packed.set(body, now);
  return now;
}

/** `find` gives what lies at a path, or nothing: that is answered by 404. */
export async function serve(find: (path: string) => Body | undefined): Promise<Server> {
  const server = createServer((request, response) => {
    const path = new URL(request.url ?? "/", "http://localhost").pathname;
    const body = find(path);
    const type = TYPES[extname(path)] ?? "application/octet-stream";
    if (body === undefined) response.writeHead(404).end("not here");
    else if (type.startsWith("image/")) response.writeHead(200, { "Content-Type": type }).end(body);
    else response.writeHead(200, { "Content-Type": type, "Content-Encoding": "gzip" }).end(pack(body));
  });
  await new Promise<void>((ready) => server.listen(0, "127.0.0.1", ready));
  return {
    root: `http://localhost:${(server.address() as AddressInfo).port}`,
    close: () =>
      new Promise((done) => {
        server.closeAllConnections();
        server.close(() => done());
      }),
  };
}

/** `change` may give a file another content. */
export function serveFolder(
  folder: string,
  change: (path: string, body: Uint8Array) => Body = (_, body) => body,
): Promise<Server> {
  const files = new Map<string, Body>();
  return serve((path) => {
    const file = join(folder, normalize(path.endsWith("/") ? `${path}index.html` : path));
    if (!files.has(file) && existsSync(file) && statSync(file).isFile())
      files.set(file, change(path, readFileSync(file)));
    return files.get(file);
  });
}

// SPDX-License-Identifier: MIT
// Pages that `tribo` writes, opened as files: what they ask for, what goes wrong in them, and what a view shows.
import type { Page } from "playwright-core";

/** All that a page asks for and complains of from now on. */
export function watch(page: Page): { asked: string[]; problems: string[] } {
  const asked: string[] = [];
  const problems: string[] = [];
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  page.on("request", (request) => asked.push(request.url()));
  return { asked, problems };
}

/** How many pixels of a view are drawn and of each colour, and a number that changes with the picture. */
export function coloursOf(page: Page, canvas: string) {
  return page.evaluate(async (selector) => {
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    const seen = { drawn: 0, bright: 0, dull: 0, orange: 0, purple: 0, yellow: 0, sum: 0 };
    const view = document.querySelector<HTMLCanvasElement>(selector);
    const flat = document.createElement("canvas");
    flat.width = view?.width ?? 0;
    flat.height = view?.height ?? 0;
    const context = flat.getContext("2d");
    if (!view || !context) return seen;
    context.drawImage(view, 0, 0);
    const bytes = context.getImageData(0, 0, flat.width, flat.height).data;
    for (let n = 0; n < bytes.length; n += 4) {
      const [r, g, b, a] = bytes.subarray(n, n + 4) as unknown as [number, number, number, number];
      if (a === 0) continue;
      ++seen.drawn;
      seen.sum = (31 * seen.sum + r + 3 * g + 7 * b + n) % 1_000_000_007;
      if (Math.abs(r - g) < 12 && Math.abs(b - g) < 16) ++seen[g > 160 ? "bright" : "dull"];
      if (r > 1.4 * b && r > 1.2 * g) ++seen.orange;
      if (b > 1.15 * g && r > 1.03 * g) ++seen.purple;
      if (r > 200 && g > 150 && b < 60) ++seen.yellow;
    }
    return seen;
  }, canvas);
}

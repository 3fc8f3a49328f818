// SPDX-License-Identifier: MIT
// npm run pictures [JOB ...]: renders the examples by `tribo` and keeps a small picture of each finished part in pictures/ (of all, or
// of these jobs). Chromium makes it small. Beside the part and its shadow it is clear: the page gives the ground.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launch } from "../testing/browser.js";
import { PROGRAM, ROOT } from "../tools/places.js";
import { EXAMPLES, HIGH, pictureOf, WIDE } from "./src/gallery/list.js";

// Of the gallery, and of the part that stands for the first one until the page has milled it.
const SMALL = { wide: WIDE, high: HIGH, quality: 0.82 };
const POSTER = { wide: 2 * WIDE, high: 2 * HIGH, quality: 0.6 };
const wanted = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "tribo-pictures-"));
const browser = await launch();
const page = await browser.newPage();

async function keep(name: string, png: string, size: typeof SMALL): Promise<void> {
  const webp = await page.evaluate(
    async ([source, { wide, high, quality }]) => {
      const picture = new Image();
      picture.src = source;
      await picture.decode();
      const small = document.createElement("canvas");
      small.width = wide;
      small.height = high;
      const c = small.getContext("2d")!;
      c.imageSmoothingQuality = "high";
      const scale = Math.min(wide / picture.width, high / picture.height);
      const [w, h] = [scale * picture.width, scale * picture.height];
      c.drawImage(picture, (wide - w) / 2, (high - h) / 2, w, h);
      return small.toDataURL("image/webp", quality).split(",")[1]!;
    },
    [png, size] as const,
  );
  const bytes = Buffer.from(webp, "base64");
  writeFileSync(join(import.meta.dirname, "pictures", name), bytes);
  console.log(`${name} ${bytes.length}`);
}

for (const example of EXAMPLES) {
  if (wanted.length > 0 && !wanted.includes(example.job)) continue;
  const job = join(ROOT, "examples", example.folder, example.job);
  execFileSync(PROGRAM, ["render", job, "--out", join(folder, example.job), "--only", "report"], { stdio: "ignore" });
  const report = readFileSync(join(folder, example.job, "report.html"), "utf8");
  const png = /src="(data:image\/png;base64,[^"]*)"/.exec(report)![1]!;
  await keep(pictureOf(example), png, SMALL);
  if (example === EXAMPLES[0]) await keep("poster.webp", png, POSTER);
}
await browser.close();
rmSync(folder, { recursive: true, force: true });

// SPDX-License-Identifier: MIT
// npm run film: films the first half minute of the page in Chromium, as docs/film.mp4 with its sound and docs/film.webp for the README.
// The pictures are taken in slow motion, for the graphics of a processor are slow; the sound is taken in a run of its own. Needs the
// built site, and ffmpeg with libwebp and libx264.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { launch } from "../testing/browser.js";
import { serveFolder } from "../testing/server.js";
import { ROOT, SITE } from "../tools/places.js";

const VIEW = { width: 1280, height: 800 };
const VIEW_TO_HEAR = { width: 640, height: 480 };
// Times slower than the clock of the world.
const SLOWER = 24;
// Of the finished part before the film, s.
const PRELUDE_S = 3;
const LONGEST_S = 60;
const VIDEO_RATE = 15;
const SMALL = { rate: 8, width: 640, mostBytes: 2e6, qualities: [60, 50, 40, 30, 20, 10] };

interface Filmed {
  /** Of each picture, s after the click that begins the film. */
  pictures: { at: number; path: string }[];
  ends: number;
}

const slowed = (slower: number) => `{
  const now = performance.now.bind(performance);
  performance.now = () => now() / ${slower};
}\n`;

// All that sounds, as a WebM file; window.sounded gives it.
const hears = `{
  const { connect } = AudioNode.prototype;
  let recorder;
  const parts = [];
  AudioNode.prototype.connect = function (to, ...more) {
    if (to === this.context.destination && !recorder) {
      const tap = this.context.createMediaStreamDestination();
      connect.call(this, tap);
      recorder = new MediaRecorder(tap.stream, { mimeType: "audio/webm;codecs=opus", audioBitsPerSecond: 160000 });
      recorder.ondataavailable = ({ data }) => parts.push(data);
      recorder.onstart = () => (window.soundBegan = performance.now() / 1000);
      recorder.start(500);
    }
    return connect.call(this, to, ...more);
  };
  window.sounded = async () => {
    await new Promise((done) => ((recorder.onstop = done), recorder.stop()));
    const url = await new Promise((done) => {
      const reader = new FileReader();
      reader.onload = () => done(reader.result);
      reader.readAsDataURL(new Blob(parts));
    });
    return url.slice(url.indexOf(",") + 1);
  };
}\n`;

const clockOf = (page: Page) => page.evaluate(() => performance.now() / 1000);
const phaseOf = (page: Page) => page.evaluate(() => document.body.dataset.film ?? "ended");

// Plays the film from a first visit on. `each` is called again and again with the time since its click, s.
async function play(page: Page, each: (at: number) => Promise<void>): Promise<{ clicked: number; ends: number }> {
  await page.waitForSelector("#hear-it:visible", { timeout: 120_000 });
  const begun = await clockOf(page);
  let now = begun;
  for (; now < begun + PRELUDE_S; now = await clockOf(page)) await each(now - begun - PRELUDE_S);
  await page.click("#hear-it");
  const clicked = await clockOf(page);
  for (now = clicked; (await phaseOf(page)) !== "ended"; now = await clockOf(page)) {
    await each(now - clicked);
    if (now > clicked + LONGEST_S) throw new Error("the film does not end");
  }
  return { clicked, ends: now - clicked };
}

async function film(folder: string, root: string): Promise<Filmed> {
  const browser = await launch();
  const page = await browser.newPage({ viewport: VIEW });
  await page.addInitScript(slowed(SLOWER));
  await page.route(/workshop_worker/, async (route) => {
    const script = await route.fetch();
    await route.fulfill({ response: script, body: slowed(SLOWER) + (await script.text()) });
  });
  await page.goto(`${root}/mill/`);
  const pictures: Filmed["pictures"] = [];
  const { ends } = await play(page, async (at) => {
    if (at - (pictures.at(-1)?.at ?? -Infinity) < 1 / VIDEO_RATE) return;
    const path = join(folder, `${pictures.length}.jpg`);
    await page.screenshot({ path, type: "jpeg", quality: 95 });
    pictures.push({ at, path });
  });
  await browser.close();
  return { pictures, ends };
}

// Returns when the sound begins, s after the click.
async function hear(path: string, root: string): Promise<number> {
  const browser = await launch();
  const page = await browser.newPage({ viewport: VIEW_TO_HEAR });
  await page.addInitScript(hears);
  await page.goto(`${root}/mill/`);
  const { clicked, ends } = await play(page, () => page.waitForTimeout(200));
  const heard = (await page.evaluate("sounded()")) as string;
  writeFileSync(path, Buffer.from(heard, "base64"));
  const began = (await page.evaluate("soundBegan")) as number;
  await browser.close();
  console.log(`sound: from ${(began - clicked).toFixed(2)} s on, the film ends at ${ends.toFixed(2)} s`);
  return began - clicked;
}

function encode(...options: (string | number)[]): void {
  execFileSync("ffmpeg", ["-hide_banner", "-loglevel", "error", "-y", ...options.map(String)], { stdio: "inherit" });
}

const folder = mkdtempSync(join(tmpdir(), "tribo-film-"));
const server = await serveFolder(SITE);
const sound = join(folder, "sound.webm");
const began = (await hear(sound, server.root)) + PRELUDE_S;
const { pictures, ends } = await film(folder, server.root);
await server.close();
const longest = Math.max(...pictures.slice(1).map(({ at }, n) => at - pictures[n]!.at));
console.log(
  `pictures: ${pictures.length}, at most ${longest.toFixed(2)} s apart; the film ends at ${ends.toFixed(2)} s`,
);
const list = join(folder, "pictures.txt");
const lasts = (n: number) => (pictures[n + 1]?.at ?? ends) - pictures[n]!.at;
writeFileSync(list, pictures.map(({ path }, n) => `file '${path}'\nduration ${lasts(n).toFixed(4)}\n`).join(""));

const shown = ["-f", "concat", "-safe", 0, "-i", list];
const video = ["-c:v", "libx264", "-preset", "slow", "-crf", 27, "-pix_fmt", "yuv420p", "-vf", `fps=${VIDEO_RATE}`];
const files = { video: join(ROOT, "docs/film.mp4"), small: join(ROOT, "docs/film.webp") };
const heard = ["-itsoffset", began.toFixed(3), "-i", sound, "-c:a", "aac", "-b:a", "96k"];
encode(...shown, ...heard, ...video, "-movflags", "+faststart", files.video);
for (const quality of SMALL.qualities) {
  const filter = `fps=${SMALL.rate},scale=${SMALL.width}:-2:flags=lanczos`;
  encode(
    ...shown,
    "-vf",
    filter,
    "-c:v",
    "libwebp_anim",
    "-quality",
    quality,
    "-compression_level",
    6,
    "-loop",
    0,
    files.small,
  );
  if (statSync(files.small).size <= SMALL.mostBytes) break;
}
for (const file of Object.values(files)) console.log(`${file} ${statSync(file).size}`);
rmSync(folder, { recursive: true, force: true });

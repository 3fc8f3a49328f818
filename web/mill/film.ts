// SPDX-License-Identifier: MIT
// npm run film: films the first half minute of the page in Chromium, as docs/film.mp4 with its sound and docs/film.webp for the README.
// The pictures are taken in slow motion, for the graphics of a processor are slow; the sound is made for their times by the same modules.
// Needs the built site, and ffmpeg with libwebp and libx264.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { decodeFrame } from "@tribo/protocol/frames";
import type { AnyExports, MillExports, MillSoundExports } from "@tribo/wasm/exports";
import { floatsAt, lend, textAt } from "@tribo/wasm/memory";
import { openMill, putFile, tickMill } from "@tribo/wasm/mill";
import { obey } from "@tribo/wasm/mill_command";
import { instantiate } from "@tribo/wasm/module";
import { launch } from "../testing/browser.js";
import { serveFolder } from "../testing/server.js";
import { MODULES, ROOT, SITE } from "../tools/places.js";
import { RATE } from "./src/learn/clip.js";

const VIEW = { width: 1280, height: 800 };
const BOWL = join(ROOT, "examples/bowl");
// Times slower than the clock of the world.
const SLOWER = 24;
// Of the finished part before the film, s.
const PRELUDE_S = 3;
const LONGEST_S = 60;
const VIDEO_RATE = 15;
// Speeds are those of so long; farther from a picture's time the clock is set anew, s.
const EVEN_S = 0.5;
const APART_S = 0.2;
const SMALL = { rate: 8, width: 640, mostBytes: 2e6, qualities: [60, 50, 40, 30, 20, 10] };

interface Filmed {
  /** Of each picture: s after the click that begins the film, and s of the program. */
  pictures: { at: number; time: number; path: string }[];
  ends: number;
}

const slowed = (slower: number) => `{
  const now = performance.now.bind(performance);
  performance.now = () => now() / ${slower};
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
    pictures.push({ at, time: Number(await page.inputValue("#time")), path });
  });
  await browser.close();
  return { pictures, ends };
}

// The sound of the bowl to the clock of the film: what the page's own modules play for these times. Left and right interleaved.
async function soundOf({ pictures, ends }: Filmed): Promise<Float32Array> {
  const module = async <Exports extends AnyExports>(name: string) =>
    instantiate<Exports>(await WebAssembly.compile(readFileSync(join(MODULES, `${name}.wasm`))));
  const mill = await module<MillExports>("tribo");
  const ear = await module<MillSoundExports>("mill_sound");
  ear.sound_open(RATE);
  for (const name of readdirSync(BOWL)) putFile(mill, name, readFileSync(join(BOWL, name)));
  if (!openMill(mill, "bowl.toml")) throw new Error(textAt(mill, mill.mill_text()));
  const timeAt = (at: number) => {
    const next = pictures.findIndex((picture) => picture.at > at);
    const n = next < 0 ? pictures.length - 1 : Math.max(next - 1, 0);
    const [before, after] = [pictures[n]!, pictures[n + 1] ?? pictures[n]!];
    // A step back stands still.
    const speed = Math.max((after.time - before.time) / (after.at - before.at || 1), 0);
    return before.time + speed * (at - before.at);
  };
  const from = pictures[0]!.at;
  const frames = RATE / 60;
  const samples = new Float32Array(2 * frames * Math.floor(60 * (ends - from)));
  let time = NaN;
  for (let done = 0; done < samples.length; done += 2 * frames) {
    const at = from + done / 2 / RATE;
    const last = pictures.at(-1)!.at;
    const wanted = timeAt(Math.min(at, last));
    const speed = (timeAt(Math.min(at + EVEN_S, last)) - wanted) / EVEN_S;
    if (!(Math.abs(wanted - time) < APART_S * Math.max(speed, 1))) obey(mill, { op: "seek", t_s: wanted });
    if (speed > 0) obey(mill, { op: "speed", value: Math.abs(speed - 1) < 0.3 ? 1 : speed });
    obey(mill, { op: speed > 0 ? "play" : "pause" });
    for (const bytes of tickMill(mill, 1 / 60)) {
      const frame = decodeFrame(bytes);
      if (frame.kind === "state") {
        ({ time } = frame);
        ear.sound_follow(frame.time, frame.speed, Number(frame.playing), 0);
      } else if (frame.kind !== "chunk") {
        lend(ear, new Uint8Array(bytes), (place, length) => ear.sound_take(place, length));
      }
    }
    samples.set(floatsAt(ear, ear.sound_render(frames), 2 * frames), done);
  }
  return samples;
}

function encode(...options: (string | number)[]): void {
  execFileSync("ffmpeg", ["-hide_banner", "-loglevel", "error", "-y", ...options.map(String)], { stdio: "inherit" });
}

const folder = mkdtempSync(join(tmpdir(), "tribo-film-"));
const server = await serveFolder(SITE);
const filmed = await film(folder, server.root);
await server.close();
const { pictures, ends } = filmed;
const longest = Math.max(...pictures.slice(1).map(({ at }, n) => at - pictures[n]!.at));
console.log(
  `${pictures.length} pictures, at most ${longest.toFixed(2)} s apart; the film ends at ${ends.toFixed(2)} s`,
);
const list = join(folder, "pictures.txt");
const lasts = (n: number) => (pictures[n + 1]?.at ?? ends) - pictures[n]!.at;
writeFileSync(list, pictures.map(({ path }, n) => `file '${path}'\nduration ${lasts(n).toFixed(4)}\n`).join(""));
const sound = join(folder, "sound.raw");
writeFileSync(sound, await soundOf(filmed));

const shown = ["-f", "concat", "-safe", 0, "-i", list];
const heard = ["-f", "f32le", "-ar", RATE, "-ac", 2, "-i", sound, "-c:a", "aac", "-b:a", "96k"];
const video = ["-c:v", "libx264", "-preset", "slow", "-crf", 27, "-pix_fmt", "yuv420p", "-vf", `fps=${VIDEO_RATE}`];
const files = { video: join(ROOT, "docs/film.mp4"), small: join(ROOT, "docs/film.webp") };
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

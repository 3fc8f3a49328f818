// SPDX-License-Identifier: MIT
// "Make your own": recordings that the test computes go into the page, a material comes out; the same as from learn.wasm alone
// and from the program.
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { hasBrowser, launch } from "../../testing/browser.js";
import { PROGRAM } from "../../tools/places.js";
import type { TriboTouch } from "../src/element.js";
import type { Voice } from "../src/material.js";
import { png, serve, servePage, type Site } from "./site.js";

type Filter = [number, number];

/** Noise through x[n] = e[n] - a1 x[n-1] - a2 x[n-2]: what its model is, is known. */
function rub(seconds: number, seed: number, [a1, a2]: Filter, level: number, rate = 44100): Int16Array {
  let state = seed;
  let x1 = 0;
  let x2 = 0;
  const uniform = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32 - 0.5;
  return Int16Array.from({ length: seconds * rate }, () => {
    const x = (uniform() + uniform() + uniform() + uniform()) * Math.sqrt(3) - a1 * x1 - a2 * x2;
    [x2, x1] = [x1, x];
    return Math.round(level * 32767 * x);
  });
}

function wav(samples: Int16Array, rate = 44100): Buffer {
  const head = Buffer.alloc(44);
  head.write("RIFF", 0, "latin1");
  head.writeUInt32LE(36 + 2 * samples.length, 4);
  head.write("WAVEfmt ", 8, "latin1");
  head.writeUInt32LE(16, 16);
  head.writeUInt16LE(1, 20);
  head.writeUInt16LE(1, 22);
  head.writeUInt32LE(rate, 24);
  head.writeUInt32LE(2 * rate, 28);
  head.writeUInt16LE(2, 32);
  head.writeUInt16LE(16, 34);
  head.write("data", 36, "latin1");
  head.writeUInt32LE(2 * samples.length, 40);
  return Buffer.concat([head, Buffer.from(samples.buffer)]);
}

// k2 = a2, k1 = a1 / (1 + a2).
const filters: Record<number, Filter> = { 60: [-1.2, 0.5], 240: [-0.6, 0.3] };
const files = Object.entries(filters).map(([speed, filter], i) => ({
  name: `felt-${speed}.wav`,
  mimeType: "audio/wav",
  buffer: wav(rub(2, 7 + i, filter, 0.02 * (i + 1))),
}));
const picture = {
  name: "felt.png",
  mimeType: "image/png",
  buffer: png(200, 150, (x, y) => [120 + ((x * 7) % 40), 90 + ((y * 5) % 40), 80]),
};

let site: Site;
let browser: Browser;
let folder: string;
beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), "tribo-make-"));
  await writeFile(join(folder, "microphone.wav"), wav(rub(8, 3, [-0.9, 0.2], 0.05, 48000), 48000));
  site = await serve();
  servePage(site);
  if (hasBrowser) {
    browser = await launch(
      "--use-fake-ui-for-media-stream",
      "--use-fake-device-for-media-stream",
      `--use-file-for-fake-audio-capture=${join(folder, "microphone.wav")}`,
    );
  }
});
afterAll(async () => {
  await browser?.close();
  await site.close();
  await rm(folder, { recursive: true, force: true });
});

async function opened() {
  site.requests.length = 0;
  const page = await browser.newPage({ viewport: { width: 900, height: 1100 }, acceptDownloads: true });
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(`${site.root}/site/index.html`);
  expect(site.requests).not.toContain("/site/learn.wasm");
  await page.locator("#own summary").click();
  await page.waitForFunction(() => document.querySelector<HTMLFormElement>("#make")?.noValidate);
  return { page, errors, said: () => page.locator("#make-said").textContent() };
}

interface MaterialFile {
  schema: string;
  image: string;
  width_mm: number;
  stiffness_n_per_mm: number;
  viscosity_n_s_per_mm: number;
  voices: Voice[];
}

async function downloaded(page: Page): Promise<{ name: string; json: MaterialFile }> {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#make-download").click()]);
  return {
    name: download.suggestedFilename(),
    json: JSON.parse(await readFile(await download.path(), "utf8")) as MaterialFile,
  };
}

describe.skipIf(!hasBrowser)("make your own", () => {
  test("learns from a picture and recordings, plays at once, and gives the file that the program gives", async () => {
    const { page, errors, said } = await opened();
    await page.locator("#make-image").setInputFiles(picture);
    await page.locator("#make-sounds").setInputFiles(files);
    await page.waitForFunction(() => document.querySelectorAll("#make-list li").length === 2);
    expect(
      await page.locator("#make-list input").evaluateAll((all) => all.map((i) => (i as HTMLInputElement).value)),
    ).toEqual(["60", "240"]);
    if (process.env.TRIBO_SHOTS) await page.screenshot({ path: `${process.env.TRIBO_SHOTS}/make.png`, fullPage: true });
    await page.locator("#make [type=submit]").click();
    await page.waitForFunction(
      () =>
        document.getElementById("make-download")?.hidden === false ||
        document.getElementById("make-said")?.className === "wrong",
    );
    expect(await said()).toContain("learned 2 voices");
    await page.waitForFunction(() => {
      const ours = document.querySelector<TriboTouch>("#ours");
      return ours?.state === "ready" && ours.material?.name === "felt" && ours.material.voices.length === 2;
    });
    // Its result stands beside the form.
    await page.locator("#made").scrollIntoViewIfNeeded();
    await page.waitForFunction(() => {
      const made = document.querySelector<TriboTouch>("#made");
      return made?.state === "ready" && made.material?.name === "felt" && made.checkVisibility();
    });
    await page.locator("#stiffness").fill(String(Math.log10(2.5)));
    const { name, json } = await downloaded(page);
    expect(name).toBe("felt.json");
    expect([json.schema, json.image, json.width_mm, json.stiffness_n_per_mm, json.viscosity_n_s_per_mm]).toEqual([
      "tribo.material/1",
      "felt.png",
      80,
      2.5,
      0.3,
    ]);
    // What the noise was made with.
    Object.values(filters).forEach(([a1, a2], i) => {
      const [k1 = 0, k2 = 0] = json.voices[i]!.reflection;
      expect(Math.abs(k1 - a1 / (1 + a2))).toBeLessThan(0.02);
      expect(Math.abs(k2 - a2)).toBeLessThan(0.03);
    });
    expect(json.voices.map((v) => v.recordings[0]!.file)).toEqual(["felt-60.wav", "felt-240.wav"]);
    expect(errors).toEqual([]);
    await page.close();
    await writeFile(join(folder, "page.json"), JSON.stringify(json));
  });

  test.skipIf(!existsSync(PROGRAM))(
    "the program learns the same numbers from the same files, and reads the page's file",
    async () => {
      for (const { name, buffer } of [...files, picture]) await writeFile(join(folder, name), buffer);
      execFileSync(
        PROGRAM,
        [
          "learn",
          "--recording",
          "60:felt-60.wav",
          "--recording",
          "240:felt-240.wav",
          "--image",
          "felt.png",
          "--width-mm",
          "80",
          "--out",
          "felt.json",
        ],
        { cwd: folder, stdio: "ignore" },
      );
      const native = JSON.parse(await readFile(join(folder, "felt.json"), "utf8")) as object;
      const ours: unknown = JSON.parse(await readFile(join(folder, "page.json"), "utf8"));
      expect(ours).toEqual({ ...native, stiffness_n_per_mm: 2.5 });
      const seen = JSON.parse(
        execFileSync(PROGRAM, ["inspect", join(folder, "page.json"), "--json"], { encoding: "utf8" }),
      ) as { kind: string };
      expect(seen.kind).toBe("material");
    },
  );

  test("learns from the microphone and from a picture that is dropped in", async () => {
    const { page, errors, said } = await opened();
    const dataTransfer = await page.evaluateHandle(
      ({ name, mimeType, bytes }) => {
        const data = new DataTransfer();
        data.items.add(new File([new Uint8Array(bytes)], name, { type: mimeType }));
        return data;
      },
      { name: picture.name, mimeType: picture.mimeType, bytes: [...picture.buffer] },
    );
    await page.dispatchEvent("#own", "drop", { dataTransfer });
    await page.waitForFunction(() => document.getElementById("make-said")?.textContent === "felt.png, 0 recordings");
    await page.locator("#make-speed").fill("150");
    await page.locator("#make-record").click();
    await page.waitForFunction(() => document.querySelectorAll("#make-list li").length === 1, null, {
      timeout: 30_000,
    });
    expect(await page.locator("#make-list").textContent()).toContain("4.0 s");
    await page.locator("#make [type=submit]").click();
    await page.locator("#make-download").waitFor();
    expect(await said()).toContain("learned 1 voice");
    const { json } = await downloaded(page);
    expect(json.voices[0]!.speed_mm_per_s).toBe(150);
    expect(Math.abs(json.voices[0]!.reflection[0]! + 0.75)).toBeLessThan(0.05);
    expect(errors).toEqual([]);
    await page.close();
  });

  test("says in words what is wrong with a file", async () => {
    const { page, errors, said } = await opened();
    const sound = (name: string, buffer: Buffer) => ({ name, mimeType: "audio/wav", buffer });
    const half = Buffer.from(files[0]!.buffer);
    half.writeUInt16LE(2, 20);
    for (const [file, words] of [
      [sound("empty.wav", Buffer.alloc(0)), "empty.wav: is empty"],
      [sound("text.wav", Buffer.from("this is no sound")), "text.wav: is no sound that this browser can read"],
      [sound("header.wav", files[0]!.buffer.subarray(0, 40)), "header.wav: is a WAV file without sound in it"],
      [sound("adpcm.wav", half), "adpcm.wav: is a WAV of a kind that is not read"],
    ] as const) {
      await page.locator("#make-sounds").setInputFiles(file);
      await page.waitForFunction((w) => document.getElementById("make-said")?.textContent?.includes(w), words);
    }
    for (const [file, words] of [
      [
        { name: "broken.png", mimeType: "image/png", buffer: picture.buffer.subarray(0, 30) },
        "broken.png: is no picture",
      ],
      [{ name: "film.gif", mimeType: "image/gif", buffer: picture.buffer }, "film.gif: is neither PNG nor JPEG"],
    ] as const) {
      await page.locator("#make-image").setInputFiles(file);
      await page.waitForFunction((w) => document.getElementById("make-said")?.textContent?.includes(w), words);
    }
    await page.locator("#make [type=submit]").click();
    expect(await said()).toContain("choose a picture first");
    await page.locator("#make-image").setInputFiles(picture);
    await page.waitForFunction(() => document.getElementById("make-said")?.textContent === "felt.png, 0 recordings");
    await page.locator("#make [type=submit]").click();
    expect(await said()).toContain("at least one recording");
    await page.locator("#make-sounds").setInputFiles(sound("silence.wav", wav(new Int16Array(44100))));
    await page.waitForFunction(() => document.querySelectorAll("#make-list li").length === 1);
    await page.locator("#make [type=submit]").click();
    await page.waitForFunction(() =>
      document.getElementById("make-said")?.textContent?.includes("silence.wav: error: is silent"),
    );
    await page.locator("#make-list button").click();
    await page.locator("#make-sounds").setInputFiles(sound("short.wav", wav(rub(0.1, 1, [-0.5, 0], 0.1))));
    await page.waitForFunction(() => document.querySelectorAll("#make-list li").length === 1);
    await page.locator("#make [type=submit]").click();
    await page.waitForFunction(() =>
      document.getElementById("make-said")?.textContent?.includes("ms of sound; give at least 0.2 s"),
    );
    expect(errors).toEqual([]);
    await page.close();
  });
});

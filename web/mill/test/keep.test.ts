// SPDX-License-Identifier: MIT
// What is taken away from the page: files, links and videos, and what comes of damaged ones.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { Settings } from "@tribo/protocol/messages";
import type { Row } from "@tribo/protocol/frames";
import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, JOB, MillPage, PROGRAM } from "../../testing/mill_page.js";
import { glb } from "../src/keep/glb.js";
import { changesOf, fragmentOf, LONGEST_FRAGMENT, pack, packedIn, unpack, type Moment } from "../src/keep/moment.js";
import { rowsCsv } from "../src/keep/rows_csv.js";
import { stl } from "../src/keep/stl.js";
import { withLength } from "../src/keep/webm.js";
import type { JobFile } from "../src/sources/workshop.js";

const PIECE = {
  positions: [0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 5],
  indices: [0, 1, 2, 0, 2, 1, 0, 3, 1, 0, 0, 0],
  onBlank: [255, 255, 255, 0],
};

describe("a file to take away", () => {
  it("has all triangles, with their normals", () => {
    const view = new DataView(stl([PIECE, PIECE]));
    expect(view.getUint32(80, true)).toBe(8);
    expect(view.byteLength).toBe(84 + 8 * 50);
    const floats = (triangle: number, first: number) =>
      [0, 1, 2].map((k) => view.getFloat32(84 + 50 * triangle + 4 * (first + k), true));
    expect(floats(0, 0)).toEqual([0, 0, 1]);
    expect(floats(1, 0)).toEqual([0, 0, -1]);
    expect(floats(6, 0)).toEqual([0, 1, 0]);
    expect(floats(3, 0)).toEqual([0, 0, 0]);
    expect([floats(0, 3), floats(0, 6), floats(0, 9)]).toEqual([
      [0, 0, 0],
      [2, 0, 0],
      [0, 3, 0],
    ]);
  });
  it("has a line for each row, in degrees and mm", () => {
    const row = {
      time: 1.5,
      duration: 0.25,
      line: 7,
      tip: [1, 2, 3],
      rpm: 6000,
      meanForce: 10,
      peakForce: Math.fround(20.1),
      torque: 0.5,
      depth: 2,
      entry: 0,
      exit: Math.PI,
      feedPerTooth: 0.1,
      chip: 0.08,
      multiplier: 0,
    } as unknown as Row;
    const [head, first, ...rest] = rowsCsv([row]).split("\n");
    expect(head!.split(",").length).toBe(first!.split(",").length);
    expect(first).toBe("1.5,0.25,7,1,2,3,6000,10,20.1,0.5,2,0,180,0.1,0.08,");
    expect(rest).toEqual([""]);
  });
  it("has both metals as glTF, in metres with y up", async () => {
    const bytes = await glb([PIECE, PIECE], { metal: true, machined: 0xffffff, untouched: 0 }).arrayBuffer();
    const view = new DataView(bytes);
    expect(new TextDecoder().decode(bytes.slice(0, 4))).toBe("glTF");
    expect([view.getUint32(4, true), view.getUint32(8, true)]).toEqual([2, bytes.byteLength]);
    const length = view.getUint32(12, true);
    expect(length % 4).toBe(0);
    const json = JSON.parse(new TextDecoder().decode(bytes.slice(20, 20 + length)));
    expect(json.accessors[0]).toMatchObject({ count: 8, min: [0, 0, 0], max: [2, 3, 5] });
    expect(json.materials[0].pbrMetallicRoughness.baseColorFactor).toEqual([1, 1, 1, 1]);
    const m = json.nodes[0].matrix as number[];
    const place = (p: number[]) =>
      [0, 1, 2].map((row) => p.reduce((sum, v, k) => sum + m[4 * k + row]! * v, m[12 + row]!));
    [0.001, 0.003, -0.002].forEach((metres, k) => expect(place([1, 2, 3])[k]).toBeCloseTo(metres, 12));
    // The triangle that leaves the blank is machined, the three others are stock.
    const [machined, stock] = json.meshes[0].primitives as { indices: number; material: number }[];
    const triangles = ({ indices }: { indices: number }) => {
      const { byteOffset, count } = json.accessors[indices] as { byteOffset: number; count: number };
      const at = 28 + length + json.bufferViews[1].byteOffset + byteOffset;
      return Array.from(new Uint32Array(bytes.slice(at, at + 4 * count)));
    };
    expect([machined!.material, triangles(machined!)]).toEqual([0, [0, 3, 1, 4, 7, 5]]);
    expect([stock!.material, triangles(stock!).slice(9)]).toEqual([1, [4, 5, 6, 4, 6, 5, 4, 4, 4]]);
  });
  it("is a node without a mesh where all is cut away", async () => {
    const bytes = await glb([], { metal: false, machined: 0, untouched: 0 }).arrayBuffer();
    const json = JSON.parse(new TextDecoder().decode(bytes.slice(20)));
    expect(json.nodes).toHaveLength(1);
    expect([json.meshes, json.nodes[0].mesh]).toEqual([undefined, undefined]);
  });
});

describe("the head of a video", () => {
  // An EBML head, a segment of unknown size with an information of a time scale, and a cluster.
  const info = [0x2a, 0xd7, 0xb1, 0x83, 0x0f, 0x42, 0x40];
  const segment = [0x18, 0x53, 0x80, 0x67, 0x01, 255, 255, 255, 255, 255, 255, 255];
  const before = [0x1a, 0x45, 0xdf, 0xa3, 0x84, 0x42, 0x86, 0x81, 1, ...segment, 0x15, 0x49, 0xa9, 0x66];
  const after = [0x1f, 0x43, 0xb6, 0x75, 0xff];

  it("gets the length of the video, once", () => {
    const told = withLength(new Uint8Array([...before, 0x80 + info.length, ...info, ...after]), 1500);
    const duration = [0x44, 0x89, 0x88, 0x40, 0x97, 0x70, 0, 0, 0, 0, 0];
    expect([...told]).toEqual([...before, 1, 0, 0, 0, 0, 0, 0, 18, ...info, ...duration, ...after]);
    expect(withLength(told, 7)).toBe(told);
  });
  it("stays as it is where it is no such head", () => {
    for (const bytes of [[], [0], [1, 2, 3], after, before, [...before, 0x90, ...info]]) {
      const head = new Uint8Array(bytes);
      expect(withLength(head, 1500)).toBe(head);
    }
  });
});

describe("a moment", () => {
  const none = () => Promise.reject(new Error("the example is not here"));
  const moment = (...files: JobFile[]): Moment => ({
    order: { files, job: files[0]!.name, part: "", cell: 0 },
    t_s: 1.25,
    changes: [{ key: "feed_percent", value: 150 }],
    view: { position: [1, -2, 3], target: [0, 0.5, 0] },
    colouring: "force",
  });
  const bytes = (text: string) => new TextEncoder().encode(text).buffer;
  const small = moment(
    { name: "ü/job.toml", bytes: bytes(JOB) },
    { name: "p.nc", bytes: new Uint8Array([0, 255, 10]).buffer },
  );

  it("comes out of its link as it went in", async () => {
    const fragment = fragmentOf(await pack(small, false))!;
    expect(fragment).toMatch(/^#moment=[\w-]+$/);
    expect(await unpack(packedIn(fragment)!, none)).toEqual(small);
  });
  it("names what lies beside the page in a link, and carries it in a file", async () => {
    const example = { name: "bowl.csv", bytes: bytes("1,2,3\n".repeat(100)), beside: true };
    const both = moment({ name: "bowl.toml", bytes: bytes(JOB) }, example);
    const asked: string[] = [];
    const { order } = await unpack((await pack(both, false)) as BlobPart, (name) => {
      asked.push(name);
      return Promise.resolve(example);
    });
    expect(asked).toEqual(["bowl.csv"]);
    expect(order.files[1]).toEqual(example);
    const whole = await unpack((await pack(both, true)) as BlobPart, none);
    expect(whole.order.files.map((f) => f.bytes.byteLength)).toEqual(both.order.files.map((f) => f.bytes.byteLength));
  });
  it("has no link where that would be too long", async () => {
    const noise = Uint8Array.from({ length: LONGEST_FRAGMENT }, (_, n) => (Math.imul(n * n, 2654435761) >>> 13) & 255);
    expect(fragmentOf(await pack(moment({ name: "a.nc", bytes: noise.buffer }), false))).toBeUndefined();
  });
  it("is refused in words if it is damaged", async () => {
    expect(packedIn("#else")).toBeUndefined();
    const fragment = fragmentOf(await pack(small, false))!;
    for (const wrong of [fragment.slice(0, -9), fragment.slice(0, 12), "#moment=", "#moment=!!", "#moment=AAAA"])
      await expect(unpack(packedIn(wrong)!, none)).rejects.toThrow(/damaged, perhaps its end was cut off/);
    const other: Moment = { ...small, view: { position: [1, 2, Number.NaN], target: [0, 0, 0] } };
    await expect(unpack((await pack(other, false)) as BlobPart, none)).rejects.toThrow(/another version/);
  });
  it("has the settings that are not as the job says", () => {
    const written = { feed_percent: 100, spindle_percent: 100, helix_deg: 30, jnd: 1, material: "" } as Settings;
    expect(changesOf(written, { ...written, jnd: 2 })).toEqual([]);
    expect(changesOf(written, { ...written, helix_deg: 10, material: "ti6al4v" })).toEqual([
      { key: "helix_deg", value: 10 },
      { key: "material", value: "ti6al4v" },
    ]);
  });
});

describe.runIf(hasMillPage)("taken away from the page without an engine", () => {
  let mill: MillPage;
  let page: Page;

  beforeAll(async () => {
    mill = await MillPage.open();
    ({ page } = mill);
    await page.click("#show-panel");
    await mill.load(file("job.toml", JOB), file("p.nc", PROGRAM));
  }, PATIENCE_MS);

  afterAll(() => mill?.close());

  async function got(id: string): Promise<{ name: string; path: string; bytes: Buffer }> {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#${id}`)]);
    const name = download.suggestedFilename();
    const path = join(mill.folder, name);
    await download.saveAs(path);
    return { name, path, bytes: readFileSync(path) };
  }

  it(
    "are the picture, the part and the rows",
    async () => {
      await page.fill("#time", "1000");
      await mill.removed(0.3);
      const shot = await got("keep-picture");
      expect(shot.name).toMatch(/^job \d+-\d\d\.png$/);
      expect(shot.bytes.subarray(1, 4).toString()).toBe("PNG");
      // A picture of one colour is a few kB.
      expect(shot.bytes.length).toBeGreaterThan(20_000);
      const { bytes: part } = await got("keep-part");
      const triangles = part.readUInt32LE(80);
      expect(triangles).toBeGreaterThan(100);
      expect(part.length).toBe(84 + 50 * triangles);
      const { bytes: model } = await got("keep-glb");
      const json = JSON.parse(model.subarray(20, 20 + model.readUInt32LE(12)).toString());
      const [machined, stock] = json.meshes[0].primitives.map(
        (p: { indices: number }) => json.accessors[p.indices].count,
      );
      expect(machined).toBeGreaterThan(100);
      expect(machined + stock).toBe(3 * triangles);
      const rows = (await got("keep-rows")).bytes.toString().trim().split("\n");
      expect(rows[0]).toContain("peak_force_n");
      expect(rows.length).toBeGreaterThan(10);
    },
    PATIENCE_MS,
  );

  it(
    "is a video with sound of what plays",
    async () => {
      await page.selectOption("#speed", "0.1");
      await page.fill("#time", "1.2");
      await page.click("#keep-video");
      await page.waitForSelector('#keep-video[aria-pressed="true"]', { timeout: PATIENCE_MS });
      await page.click("#play");
      await mill.until("Pause", "play");
      // Its length and its size are told.
      await page.waitForFunction(
        () =>
          /\(\d+:(?!0[01])\d\d, (?!0\.0)\d+\.\d MB\)/.test(document.getElementById("keep-video")?.textContent ?? ""),
        null,
        { timeout: PATIENCE_MS },
      );
      await mill.picture("video");
      const { name, bytes } = await got("keep-video");
      expect(name).toMatch(/^job \d+-\d\d\.webm$/);
      await mill.until("Video", "keep-video");
      await page.click("#play");
      await mill.until("Play", "play");
      // The browser itself reads picture and sound of it.
      const seen = await page.evaluate(async (base64) => {
        const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
        const context = new OfflineAudioContext(1, 1, 48000);
        const sound = await context.decodeAudioData(data.buffer.slice(0));
        const samples = sound.getChannelData(0);
        const video = document.createElement("video");
        video.src = URL.createObjectURL(new Blob([data], { type: "video/webm" }));
        await new Promise((done, fail) => {
          video.onloadeddata = done;
          video.onerror = () => fail(new Error(video.error?.message));
        });
        video.muted = true;
        const shown = new Promise((done) => video.requestVideoFrameCallback(done));
        await video.play();
        await shown;
        const canvas = new OffscreenCanvas(100, 70);
        const c = canvas.getContext("2d")!;
        c.drawImage(video, 0, 0, 100, 70);
        return {
          colours: new Set(new Uint32Array(c.getImageData(0, 0, 100, 70).data.buffer)).size,
          length: video.duration,
          seconds: sound.duration,
          level: samples.reduce((most, v) => Math.max(most, Math.abs(v)), 0),
          width: video.videoWidth,
          height: video.videoHeight,
        };
      }, bytes.toString("base64"));
      expect(seen.seconds).toBeGreaterThan(1);
      expect(Math.abs(seen.length - seen.seconds)).toBeLessThan(1);
      expect(seen.colours).toBeGreaterThan(100);
      expect(seen.level).toBeGreaterThan(0.01);
      expect([seen.width, seen.height]).toEqual([1000, 700]);
    },
    PATIENCE_MS,
  );

  it(
    "is a link that opens job, moment and view again",
    async () => {
      await page.selectOption("#material", "ti6al4v");
      await page.selectOption("#colouring", "force");
      await page.focus("#scene");
      for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "+"]) await page.keyboard.press(key);
      await page.click("#keep-link");
      await page.waitForSelector("#link-box:not([hidden])");
      await mill.until("characters", "link-said");
      const link = await page.inputValue("#link");
      expect(link.length).toBeLessThan(1500);
      expect(await violations(page)).toEqual([]);
      await mill.picture("link");
      const visitor = await mill.browser.newPage({ viewport: { width: 1000, height: 700 } });
      mill.watch(visitor);
      await visitor.goto(link);
      for (const id of ["job", "clock", "peak", "removed"])
        await expect
          .poll(() => visitor.textContent(`#${id}`), { timeout: PATIENCE_MS })
          .toBe(await page.textContent(`#${id}`));
      expect(await visitor.inputValue("#colouring")).toBe("force");
      expect(await visitor.inputValue("#material")).toBe("ti6al4v");
      await visitor.click("#show-panel");
      await visitor.click("#keep-link");
      await visitor.waitForSelector("#link-box:not([hidden])");
      await expect.poll(() => visitor.inputValue("#link"), { timeout: PATIENCE_MS }).not.toBe("");
      // Time, view and job again, so the same link.
      expect(await visitor.inputValue("#link")).toBe(link);
      // Another job takes the address of the first one away.
      await visitor.setInputFiles("#files", [file("alone.nc", PROGRAM.replace("G21", "G21 S8000 F600"))]);
      await visitor.waitForFunction(() => document.getElementById("job")?.textContent === "alone.nc");
      expect(visitor.url()).not.toContain("#moment");
      // And a damaged link is refused where the page is, which goes on.
      await visitor.evaluate((hash) => (location.hash = hash), new URL(link).hash.slice(0, -20));
      await visitor.waitForFunction(
        () => document.getElementById("notice")?.textContent?.startsWith("The link cannot be opened: it is damaged"),
        null,
        { timeout: PATIENCE_MS },
      );
      expect(await visitor.textContent("#job")).toBe("alone.nc");
      await visitor.close();
    },
    PATIENCE_MS,
  );

  it(
    "is a short link of an example, and the example where a link is broken",
    async () => {
      // Without the film of a first visit, which takes the button away.
      const visitor = await mill.browser.newPage({ reducedMotion: "reduce" });
      mill.watch(visitor);
      await visitor.goto(`${mill.server.root}/mill/#moment=broken`);
      await visitor.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
      expect(await visitor.textContent("#job")).toBe("bowl.toml");
      await visitor.waitForSelector('#notice:text("The link cannot be opened")', { timeout: PATIENCE_MS });
      await visitor.click("#show-panel");
      await visitor.click("#keep-link");
      await visitor.waitForSelector("#link-box:not([hidden])");
      await expect.poll(() => visitor.inputValue("#link"), { timeout: PATIENCE_MS }).not.toBe("");
      const link = await visitor.inputValue("#link");
      expect(link.length).toBeLessThan(1000);
      await visitor.evaluate((hash) => (location.hash = hash), new URL(link).hash);
      await visitor.waitForSelector("#notice-box", { state: "hidden" });
      await visitor.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
      expect(await visitor.textContent("#job")).toBe("bowl.toml");
      await visitor.close();
    },
    PATIENCE_MS,
  );

  it(
    "is a small file where a link would be too long",
    async () => {
      const words = Array.from({ length: 4000 }, (_, n) => `(${Math.imul(n, 2654435761) >>> 0})`).join("\n");
      await mill.load(file("long.toml", JOB), file("p.nc", `${PROGRAM}${words}\n`));
      await mill.until("long.toml", "job");
      expect(await page.isVisible("#link-box")).toBe(false);
      await page.fill("#time", "1.2");
      await mill.until("0:01 /", "clock");
      const { name, path, bytes } = await got("keep-link");
      expect(name).toBe("long 0-01.moment");
      expect(bytes.length).toBeLessThan(60_000);
      expect(await mill.text("link-said")).toContain("Too long for a link (16000 characters at most)");
      expect(await page.isVisible("#link")).toBe(false);
      await mill.load(file("alone.nc", PROGRAM.replace("G21", "G21 S8000 F600")));
      await mill.until("alone.nc", "job");
      await page.setInputFiles("#files", path);
      await mill.until("long.toml", "job");
      await mill.until("0:01 /", "clock");
      writeFileSync(path, bytes.subarray(0, 1000));
      await page.setInputFiles("#files", path);
      await mill.until(`${name} cannot be opened: it is damaged`, "notice");
      await page.click("#dismiss");
      expect(await mill.text("job")).toBe("long.toml");
    },
    PATIENCE_MS,
  );

  it("has no video where the browser cannot make one", async () => {
    const visitor = await mill.browser.newPage();
    await visitor.addInitScript("delete window.MediaRecorder");
    await visitor.goto(`${mill.server.root}/mill/`);
    await visitor.click("#show-panel");
    await visitor.waitForSelector("#keep-picture");
    expect(await visitor.isVisible("#keep-video")).toBe(false);
    await visitor.close();
  });

  it("makes no error", () => {
    expect(mill.foreign).toEqual([]);
    expect(mill.problems).toEqual([]);
  });
});

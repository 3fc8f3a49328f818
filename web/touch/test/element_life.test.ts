// SPDX-License-Identifier: MIT
// <tribo-touch> from its loading to its removal: alone and among many, and what it does when something is missing or lost.
import { describe, expect, test } from "vitest";
import { fingers, hasBrowser } from "../../testing/browser.js";
import type { TriboTouch } from "../src/element.js";
import {
  kTag,
  kPatience,
  site,
  errors,
  settled,
  log,
  heap,
  changed,
  frames,
  open,
  type AnyCanvas,
} from "./element_page.js";

describe.skipIf(!hasBrowser)("tribo-touch from its loading to its end", () => {
  test("follows a change of size and of attributes", async () => {
    const page = await open(kTag);
    await settled(page);
    await page.evaluate(() => {
      window.t.style.width = "128px";
    });
    await page.waitForFunction(() => window.t.shadowRoot!.querySelector("canvas")!.width === 128);
    await page.setViewportSize({ width: 200, height: 400 });
    await page.evaluate(() => {
      window.t.stiffness = 7;
      window.t.damping = 0.3;
    });
    expect(await page.evaluate(() => [window.t.stiffness, window.t.damping])).toEqual([7, 0.3]);
    await page.evaluate(() => {
      window.t.disabled = true;
    });
    const hand = await fingers(page);
    await hand.touch([{ x: 50, y: 50 }]);
    await frames(page, 3);
    expect(await log(page, "contact-start")).toHaveLength(0);
    await hand.touch([]);
    await page.evaluate(() => {
      window.t.disabled = false;
      window.t.asPublished = true;
    });
    await settled(page);
    await hand.touch([{ x: 50, y: 50 }]);
    await page.waitForFunction(() => window.log.some((e) => e.n === "contact-move" && e.depth_mm > 0.03));
    await hand.touch([]);
    expect(errors).toEqual([]);
  });

  test("loads only when it comes near the view, and shows a poster until then", async () => {
    const page = await open(`<div style="height:3000px"></div>${kTag.replace("id=", 'poster="plain.png" id=')}`);
    await page.waitForTimeout(300);
    expect(await page.evaluate(() => window.t.state)).toBe("idle");
    expect(await page.evaluate(() => window.t.shadowRoot!.querySelector<HTMLElement>("[part=poster]")!.hidden)).toBe(
      false,
    );
    await page.evaluate(() => window.t.scrollIntoView());
    await settled(page);
    expect(await page.evaluate(() => window.t.shadowRoot!.querySelector<HTMLElement>("[part=poster]")!.hidden)).toBe(
      true,
    );
    expect((await log(page, "load")).length).toBe(1);
  });

  test("twenty elements share one context and one worklet", async () => {
    const many = Array.from({ length: 20 }, (_, i) =>
      kTag.replace('id="t"', `id="t${i}" loading="eager"`).replace("256px", "60px"),
    );
    const page = await open(`<div style="display:flex;flex-wrap:wrap">${many.join("")}</div>`, {
      before: () => {
        window.contexts = 0;
        const canvas = HTMLCanvasElement.prototype as AnyCanvas;
        const get = canvas.getContext;
        canvas.getContext = function (kind, ...rest) {
          if (kind === "webgl2") ++window.contexts;
          return get.call(this, kind, ...rest);
        };
        const Real = AudioWorkletNode;
        window.nodes = 0;
        window.AudioWorkletNode = class extends Real {
          constructor(...args: ConstructorParameters<typeof AudioWorkletNode>) {
            super(...args);
            ++window.nodes;
          }
        };
      },
    });
    await page.waitForFunction(() =>
      [...document.querySelectorAll<TriboTouch>("tribo-touch")].every((e) => e.state === "ready"),
    );
    await page.waitForFunction(() => window.nodes > 0);
    expect(await page.evaluate(() => [window.contexts, window.nodes])).toEqual([1, 1]);
    expect(site.requests.filter((path) => path === "/dist/touch.wasm").length).toBeGreaterThan(0);
    expect(errors).toEqual([]);
  });

  test("200 times added and removed leave nothing behind", async () => {
    const page = await open(kTag.replace("sponge.json", "plain.json"), {
      before: () => {
        window.made = { webgl: 0, audio: 0, worklets: 0, textures: 0 };
        const canvas = HTMLCanvasElement.prototype as AnyCanvas;
        const { getContext } = canvas;
        const { createTexture, deleteTexture } = WebGL2RenderingContext.prototype;
        canvas.getContext = function (kind, ...rest) {
          if (kind === "webgl2") ++window.made.webgl;
          return getContext.call(this, kind, ...rest);
        };
        WebGL2RenderingContext.prototype.createTexture = function () {
          ++window.made.textures;
          return createTexture.call(this);
        };
        WebGL2RenderingContext.prototype.deleteTexture = function (t) {
          --window.made.textures;
          return deleteTexture.call(this, t);
        };
        window.AudioContext = class extends AudioContext {
          constructor(options?: AudioContextOptions) {
            super(options);
            ++window.made.audio;
          }
        };
        window.AudioWorkletNode = class extends AudioWorkletNode {
          constructor(...rest: ConstructorParameters<typeof AudioWorkletNode>) {
            super(...rest);
            ++window.made.worklets;
          }
        };
      },
    });
    await settled(page);
    const cycle = (count: number) =>
      page.evaluate(async (n) => {
        for (let i = 0; i < n; ++i) {
          const element = document.createElement("tribo-touch") as TriboTouch;
          // Every other one has a voice.
          element.src = i % 2 === 0 ? "plain.json" : "sponge.json";
          element.loading = "eager";
          element.style.width = "64px";
          document.body.append(element);
          if (element.state !== "ready")
            await new Promise((done) => element.addEventListener("load", done, { once: true }));
          element.remove();
        }
      }, count);
    await cycle(20);
    const before = await heap(page);
    await cycle(200);
    await page.waitForTimeout(200);
    const after = await heap(page);
    expect(after - before).toBeLessThan(1_500_000);
    // The one element that stays has an image, heights and relief; all share the contexts.
    const { webgl, audio, worklets, textures } = await page.evaluate(() => window.made);
    expect([webgl, textures]).toEqual([1, 4]);
    expect(audio).toBeLessThanOrEqual(1);
    expect(worklets).toBeLessThanOrEqual(1);
    expect(errors).toEqual([]);
  });

  test("draws again after the context was lost", async () => {
    const page = await open(kTag, {
      before: () => {
        const canvas = HTMLCanvasElement.prototype as AnyCanvas;
        const get = canvas.getContext;
        canvas.getContext = function (kind, ...rest) {
          const made = get.call(this, kind, ...rest);
          if (kind === "webgl2") window.gl = made as WebGL2RenderingContext;
          return made;
        };
      },
    });
    await settled(page);
    await frames(page, 3);
    const drawn = () =>
      page.evaluate(() => window.t.shadowRoot!.querySelector(".surface")!.classList.contains("drawn"));
    expect(await drawn()).toBe(true);
    await page.evaluate(() => {
      window.lose = window.gl.getExtension("WEBGL_lose_context")!;
      window.lose.loseContext();
    });
    await expect.poll(drawn, kPatience).toBe(false);
    await page.evaluate(() => window.lose.restoreContext());
    await expect.poll(drawn, kPatience).toBe(true);
    await changed(page);
    const hand = await fingers(page);
    await hand.touch([{ x: 120, y: 100 }]);
    await page.waitForFunction(() => window.log.some((e) => e.n === "contact-move" && e.depth_mm > 0.5));
    expect(await changed(page)).toBeGreaterThan(100);
  });

  test.each([
    ["no WebAssembly module", "/dist/touch.wasm", undefined, "plain", "wasm"],
    ["no worklet", "/dist/worklet.js", undefined, "ready", "audio"],
    ["a voice that contradicts itself", undefined, "muddled.json", "ready", "audio"],
    ["no image", undefined, "noimage.json", "failed", "image"],
    ["no material", undefined, "gone.json", "failed", "material"],
    ["a broken material", undefined, "broken.json", "failed", "material"],
  ])("with %s it says so and shows what it can", async (_, blocked, src, state, type) => {
    if (blocked !== undefined) site.blocked.add(blocked);
    const page = await open(src === undefined ? kTag : kTag.replace("sponge.json", src));
    await page.waitForFunction((wanted) => window.log.some((e) => e.n === "error" && e.type === wanted), type);
    await settled(page);
    expect(await page.evaluate(() => window.t.state)).toBe(state);
    const image = await page.evaluate(() => {
      const { naturalWidth, alt } = window.t.shadowRoot!.querySelector("img")!;
      return { naturalWidth, alt };
    });
    expect(image).toEqual(
      state === "failed" ? { naturalWidth: 0, alt: "Yellow sponge" } : { naturalWidth: 256, alt: "" },
    );
    expect(errors).toEqual([]);
  });

  test("an output faster than voices play is an error that is seen", async () => {
    const page = await open(kTag, {
      before: () => {
        window.AudioContext = class extends AudioContext {
          constructor(options?: AudioContextOptions) {
            super({ ...options, sampleRate: 384_000 });
          }
        };
      },
    });
    await page.waitForFunction(() => window.log.some((e) => e.n === "error"));
    expect(await log(page, "error")).toMatchObject([
      { type: "audio", message: "voices: sample rate is not from 1000 to 192000 Hz" },
    ]);
    expect(errors).toEqual([]);
  });

  test("without WebGL2 the plain image stays", async () => {
    const page = await open(kTag, {
      before: () => {
        const canvas = HTMLCanvasElement.prototype as AnyCanvas;
        const get = canvas.getContext;
        canvas.getContext = function (kind, ...rest) {
          return kind === "webgl2" ? null : get.call(this, kind, ...rest);
        };
      },
    });
    await settled(page);
    expect(await page.evaluate(() => window.t.state)).toBe("plain");
    expect((await log(page, "error"))[0]?.type).toBe("webgl");
  });
});

// SPDX-License-Identifier: MIT
// <tribo-touch> in headless Chromium under real touch events: what it does when all is well, and when not.
import type { Browser, BrowserContext, BrowserContextOptions, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import { violations } from "../../testing/axe.js";
import { fingers, hasBrowser, launch } from "../../testing/browser.js";
import type { ContactDetail, TriboErrorDetail, TriboTouch } from "../src/element.js";
import { serve, type Site } from "./site.js";

/** An event of #t, with its name. */
type Told = { n: string } & ContactDetail & TriboErrorDetail;

// What the pages of these tests keep.
declare global {
  interface Window {
    t: TriboTouch;
    log: Told[];
    flat: Uint8ClampedArray;
    set: number[];
    contexts: number;
    nodes: number;
    made: { webgl: number; audio: number; worklets: number; textures: number };
    gl: WebGL2RenderingContext;
    lose: WEBGL_lose_context;
    analyser: AnalyserNode | undefined;
    shakes: { ms: number; at: number }[];
    rumbles: [string, number][];
  }
}

const kTag = '<tribo-touch id="t" src="sponge.json" alt="Yellow sponge" style="width:256px"></tribo-touch>';
const kScript = '<script type="module" src="/dist/tribo-touch.js"></script>';
/** The prototypes of browsers as a test changes them: one signature in place of many. */
interface AnyCanvas {
  getContext(kind: string, ...rest: unknown[]): unknown;
}
interface AnyNode {
  context: AudioContext;
  connect(to: AudioNode, ...rest: unknown[]): AudioNode;
}

const kPatience = { timeout: 20_000 };
let site: Site;
let browser: Browser;
let context: BrowserContext | undefined;
let errors: string[] = [];

beforeAll(async () => {
  if (!hasBrowser) return;
  site = await serve();
  browser = await launch();
});
afterAll(async () => {
  await browser?.close();
  await site?.close();
});
afterEach(async () => {
  await context?.close();
  context = undefined;
  site?.blocked.clear();
});

/** A page with this body; events of #t are kept in window.log. */
async function open(body: string, options: BrowserContextOptions & { before?: () => void } = {}): Promise<Page> {
  const { before, ...contextOptions } = options;
  context = await browser.newContext({ hasTouch: true, viewport: { width: 320, height: 320 }, ...contextOptions });
  const page = await context.newPage();
  errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  if (before !== undefined) await page.addInitScript(before);
  site.page(
    "/",
    `<script>window.log = [];
    for (const n of ["load", "error", "poster-dismissed", "contact-start", "contact-move", "contact-end"])
      document.addEventListener(n, (e) => e.target.localName === "tribo-touch" && log.push({ n, ...(e.detail ?? {}) }), true);
    </script>${kScript}${body}`,
  );
  await page.goto(`${site.root}/`);
  return page;
}
const settled = (page: Page) => page.waitForFunction(() => ["ready", "plain", "failed"].includes(window.t.state));
const log = (page: Page, name: string) => page.evaluate((n) => window.log.filter((e) => e.n === n), name);
const heap = (page: Page) =>
  page.evaluate(() => {
    const { gc, performance } = window as unknown as {
      gc?(): void;
      performance: { memory: { usedJSHeapSize: number } };
    };
    gc?.();
    return performance.memory.usedJSHeapSize;
  });
/** How many pixels of #t's canvas differ from what they were at the first call. */
const changed = (page: Page) =>
  page.evaluate(() => {
    const canvas = window.t.shadowRoot!.querySelector("canvas")!;
    const now = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height).data;
    window.flat ??= now.slice();
    let count = 0;
    for (let i = 0; i < now.length; i += 4) if (Math.abs(now[i]! - window.flat[i]!) > 6) ++count;
    return count;
  });
const frames = (page: Page, count: number) =>
  page.evaluate(
    (n) =>
      new Promise<void>((done) => {
        const next = () => {
          if (n-- > 0) requestAnimationFrame(next);
          else done();
        };
        next();
      }),
    count,
  );

describe.skipIf(!hasBrowser)("tribo-touch", () => {
  test("yields under a finger, tells of it, and comes to rest", async () => {
    const page = await open(kTag);
    await settled(page);
    expect(await page.evaluate(() => window.t.state)).toBe("ready");
    await frames(page, 3);
    expect(await changed(page)).toBe(0);
    const hand = await fingers(page);
    await hand.touch([{ x: 120, y: 100, radius: 14, radiusY: 9, force: 0.4 }]);
    await page.waitForFunction(() => window.log.some((e) => e.n === "contact-move" && e.depth_mm > 0.7));
    expect(await changed(page)).toBeGreaterThan(300);
    const [start] = await log(page, "contact-start");
    expect(start!.pointerType).toBe("touch");
    expect(start!.u).toBeCloseTo((120 - 8) / 256, 2);
    expect(start!.force_n).toBeCloseTo(3 * 0.4, 4);
    // 28 x 18 pixels of 80 mm / 256 pixels.
    expect(start!.area_mm2).toBeCloseTo(Math.PI * 14 * 9 * (80 / 256) ** 2, 1);
    await hand.touch([]);
    await expect.poll(() => changed(page), kPatience).toBe(0);
    expect(await log(page, "contact-end")).toHaveLength(1);
    expect(errors).toEqual([]);
  });

  test("is lit by its small relief, out of its image or a map as large as it", async () => {
    // Of a dent, how much neighbours along a row differ in the mean.
    const grain = async (src: string) => {
      const page = await open(kTag.replace("sponge.json", src).replace("256px", "96px"));
      await settled(page);
      await page.waitForTimeout(500);
      const hand = await fingers(page);
      await hand.touch([{ x: 50, y: 50, force: 0.6 }]);
      await page.waitForFunction(() => window.log.some((e) => e.n === "contact-move" && e.depth_mm > 1));
      const differs = await page.evaluate(() => {
        const canvas = window.t.shadowRoot!.querySelector("canvas")!;
        const { data } = canvas.getContext("2d")!.getImageData(20, 20, 56, 56);
        let sum = 0;
        for (let i = 4; i < data.length; i += 4) if ((i / 4) % 56 > 0) sum += Math.abs(data[i]! - data[i - 4]!);
        return sum / (56 * 55);
      });
      const told = await log(page, "error");
      await page.context().close();
      return { differs, errors: told };
    };
    const plain = await grain("plain.json");
    const mapped = await grain("mapped.json");
    const wrong = await grain("mismapped.json");
    expect([plain.errors, mapped.errors]).toEqual([[], []]);
    expect(mapped.differs).toBeGreaterThan(2 * plain.differs);
    expect(wrong.errors[0]).toMatchObject({
      type: "image",
      message: expect.stringContaining(
        "ridges.png: the height map has 96 x 96 pixels; give one of 256 x 192, as the image",
      ),
    });
  });

  test("takes five fingers at once, a rub, a cancel and a mouse", async () => {
    const page = await open(kTag);
    await settled(page);
    const hand = await fingers(page);
    const five = [0, 1, 2, 3, 4].map((id) => ({ id, x: 40 + 45 * id, y: 60 + 20 * (id % 2) }));
    for (let n = 1; n <= 5; ++n) await hand.touch(five.slice(0, n));
    await frames(page, 10);
    expect(await log(page, "contact-start")).toHaveLength(5);
    for (let step = 0; step < 10; ++step) {
      await hand.touch(five.map((p) => ({ ...p, y: p.y + 6 * step })));
      await frames(page, 1);
    }
    expect(Math.max(...(await log(page, "contact-move")).map((e) => e.speed_mm_per_s))).toBeGreaterThan(5);
    await hand.cancel();
    await frames(page, 2);
    expect(await log(page, "contact-end")).toHaveLength(5);
    await page.mouse.move(100, 100);
    await page.mouse.down();
    await frames(page, 20);
    await page.mouse.move(400, 500);
    await page.mouse.up();
    await frames(page, 2);
    expect(await log(page, "contact-end")).toHaveLength(6);
    expect(errors).toEqual([]);
  });

  test("works by keyboard alone", async () => {
    const page = await open(kTag);
    await settled(page);
    await page.keyboard.press("Tab");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Space");
    await page.keyboard.press("+");
    await frames(page, 20);
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Escape");
    await frames(page, 2);
    const [start] = await log(page, "contact-start");
    expect(start).toMatchObject({ pointerType: "keyboard", u: 0.52 });
    const [end] = await log(page, "contact-end");
    expect(end!.v).toBeCloseTo(0.6, 6);
    expect(end!.depth_mm).toBeGreaterThan(0.1);
  });

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

  test("is shaded but does not shift where less motion is asked for", async () => {
    // The uniform that shifts the picture, as the shader gets it.
    const shifts = async (reducedMotion: "reduce" | "no-preference") => {
      const page = await open(kTag, {
        reducedMotion,
        before: () => {
          const set = WebGL2RenderingContext.prototype.uniform1f;
          window.set = [];
          WebGL2RenderingContext.prototype.uniform1f = function (at, value) {
            window.set.push(value);
            return set.call(this, at, value);
          };
        },
      });
      await settled(page);
      await frames(page, 2);
      const last = await page.evaluate(() => window.set.at(-1));
      await page.context().close();
      return last;
    };
    expect(await shifts("reduce")).toBe(0);
    expect(await shifts("no-preference")).toBe(1);
  });

  test("lifts all fingers when the page is hidden", async () => {
    const page = await open(kTag);
    await settled(page);
    const hand = await fingers(page);
    await hand.touch([{ x: 100, y: 100 }]);
    await frames(page, 3);
    await page.evaluate(() => {
      Object.defineProperty(document, "visibilityState", { value: "hidden", configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    });
    expect(await log(page, "contact-end")).toHaveLength(1);
    await page.evaluate(() => {
      delete (document as { visibilityState?: string }).visibilityState;
      document.dispatchEvent(new Event("visibilitychange"));
    });
    await hand.touch([]);
    await hand.touch([{ x: 120, y: 100 }]);
    await frames(page, 3);
    expect(await log(page, "contact-start")).toHaveLength(2);
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
    expect([webgl, textures]).toEqual([1, 3]);
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

  test("rubbing makes sound, standing still makes none", async () => {
    const page = await open(kTag, {
      before: () => {
        const node = AudioNode.prototype as unknown as AnyNode;
        const connect = node.connect;
        node.connect = function (to, ...rest) {
          if (to instanceof AudioDestinationNode && window.analyser === undefined) {
            window.analyser = to.context.createAnalyser();
            connect.call(this, window.analyser);
          }
          return connect.call(this, to, ...rest);
        };
      },
    });
    await settled(page);
    await page.waitForFunction(() => window.analyser !== undefined);
    const level = () =>
      page.evaluate(() => {
        const samples = new Float32Array(2048);
        window.analyser!.getFloatTimeDomainData(samples);
        return Math.sqrt(samples.reduce((sum, x) => sum + x * x, 0) / samples.length);
      });
    const hand = await fingers(page);
    await hand.touch([{ x: 40, y: 100 }]);
    await page.waitForTimeout(400);
    expect(await level()).toBe(0);
    let loudest = 0;
    for (let i = 0; i < 25; ++i) {
      await hand.touch([{ x: 40 + 6 * i, y: 100 }]);
      await frames(page, 1);
      loudest = Math.max(loudest, await level());
    }
    // -20 dB at 100 mm/s and 1 N.
    expect(loudest).toBeGreaterThan(0.01);
    expect(loudest).toBeLessThan(0.7);
    await expect.poll(level, kPatience).toBe(0);
  });

  test("a pen presses with the force that it measures; a map makes half of the image eight times as stiff", async () => {
    const page = await open(kTag.replace("id=", 'stiffness-map="halves.png" id='));
    await settled(page);
    const { cdp } = await fingers(page);
    const pen = (type: "mousePressed" | "mouseReleased", x: number, force: number) =>
      cdp.send("Input.dispatchMouseEvent", {
        type,
        x,
        y: 100,
        button: "left",
        buttons: type === "mouseReleased" ? 0 : 1,
        clickCount: 1,
        pointerType: "pen",
        force,
      });
    const last = async () => (await log(page, "contact-move")).at(-1);
    for (const [x, depth_mm] of [
      [72, 1.8 / 1.4],
      [200, 1.8 / 1.4 / 8],
    ] as const) {
      await pen("mousePressed", x, 0.5 + 0.1);
      await expect.poll(async () => (await last())?.depth_mm ?? 0, kPatience).toBeCloseTo(depth_mm, 2);
      const { pointerType, force_n } = (await last())!;
      expect([pointerType, force_n.toFixed(3)]).toEqual(["pen", "1.800"]);
      await pen("mouseReleased", x, 0);
    }
  });

  test("phones and gamepads shake while something is rubbed, and not where that is turned off", async () => {
    const page = await open(kTag, {
      before: () => {
        window.shakes = [];
        window.rumbles = [];
        // The frame's time, which a late callback does not change.
        navigator.vibrate = (ms) =>
          window.shakes.push({ ms: Number(ms), at: Number(document.timeline.currentTime) }) > 0;
        const playEffect = async (kind: string, how: GamepadEffectParameters) =>
          window.rumbles.push([kind, how.weakMagnitude ?? 0]);
        navigator.getGamepads = () => [null, { vibrationActuator: { playEffect } } as unknown as Gamepad];
      },
    });
    await settled(page);
    // To and fro by events made in the page: the browser's own protocol can be slower than a finger that stands still.
    const rub = (seconds: number) =>
      page.evaluate(async (most) => {
        const surface = window.t.shadowRoot!.querySelector(".surface")!;
        const begin = performance.now();
        const box = surface.getBoundingClientRect();
        const finger = (type: string, x: number) =>
          surface.dispatchEvent(
            new PointerEvent(type, {
              pointerId: 7,
              pointerType: "touch",
              clientX: box.x + x,
              clientY: box.y + 90,
              width: 20,
              height: 20,
              pressure: 0.6,
              button: 0,
              buttons: 1,
            }),
          );
        finger("pointerdown", 30);
        while (window.shakes.length < 3 && performance.now() - begin < 1000 * most) {
          finger("pointermove", 30 + 180 * Math.abs(Math.sin((performance.now() - begin) / 300)));
          await new Promise((done) => setTimeout(done, 4));
        }
        finger("pointerup", 30);
      }, seconds);
    await rub(20);
    const [shakes, rumbles] = await page.evaluate(() => [window.shakes, window.rumbles]);
    expect(shakes.length).toBeGreaterThanOrEqual(3);
    expect(shakes.every(({ ms }) => ms >= 2 && ms <= 12)).toBe(true);
    expect(shakes[2]!.at - shakes[0]!.at).toBeGreaterThan(59.9);
    expect(rumbles.length).toBe(shakes.length);
    const [kind, strength] = rumbles[0]!;
    expect(kind).toBe("dual-rumble");
    expect(strength).toBeCloseTo(0.9, 6);
    await page.evaluate(() => {
      window.t.setAttribute("haptics", "off");
      window.shakes.length = 0;
    });
    await rub(1);
    expect(await page.evaluate(() => window.shakes.length)).toBe(0);
  });

  test("the page passes axe-core", async () => {
    const page = await open(`<main><h1>Touch</h1>${kTag}</main>`);
    await settled(page);
    expect(await violations(page)).toEqual([]);
  });
});

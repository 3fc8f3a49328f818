// SPDX-License-Identifier: MIT
// <tribo-touch> under real touch events: what it shows, tells, sounds and shakes while something touches it.
import { describe, expect, test } from "vitest";
import { violations } from "../../testing/axe.js";
import { fingers, hasBrowser } from "../../testing/browser.js";
import { kTag, kPatience, errors, settled, log, changed, frames, open, type AnyNode } from "./element_page.js";

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

  test("keeps the trail of a rub where there is a pile, and lets its hairs rise", async () => {
    const page = await open(kTag.replace("sponge.json", "velvet.json"));
    await settled(page);
    await frames(page, 3);
    expect(await changed(page)).toBe(0);
    const hand = await fingers(page);
    for (let x = 60; x <= 180; x += 20) {
      await hand.touch([{ x, y: 100, force: 0.4 }]);
      await frames(page, 2);
    }
    await hand.touch([]);
    // The sheet is flat again after a second, the hairs are not.
    await page.waitForTimeout(2000);
    const trail = await changed(page);
    expect(trail).toBeGreaterThan(300);
    await expect.poll(() => changed(page), { timeout: 40_000 }).toBeLessThan(trail / 10);
    expect(errors).toEqual([]);
  }, 60_000);

  test("takes five fingers at once, a rub, a cancel and a mouse", async () => {
    const page = await open(kTag);
    await settled(page);
    const hand = await fingers(page);
    const five = [0, 1, 2, 3, 4].map((id) => ({ id, x: 40 + 45 * id, y: 60 + 20 * (id % 2) }));
    for (let n = 1; n <= 5; ++n) await hand.touch(five.slice(0, n));
    await expect.poll(() => log(page, "contact-start"), kPatience).toHaveLength(5);
    const fastest = async () => Math.max(0, ...(await log(page, "contact-move")).map((e) => e.speed_mm_per_s));
    // A busy machine may see the first rubs as single places.
    let step = 0;
    await expect
      .poll(async () => {
        for (let n = 0; n < 10; ++n, ++step) {
          await hand.touch(five.map((p) => ({ ...p, y: p.y + 6 * (step % 20) })));
          await frames(page, 1);
        }
        return fastest();
      }, kPatience)
      .toBeGreaterThan(5);
    await hand.cancel();
    await expect.poll(() => log(page, "contact-end"), kPatience).toHaveLength(5);
    await page.mouse.move(100, 100);
    await page.mouse.down();
    await frames(page, 20);
    await page.mouse.move(400, 500);
    await page.mouse.up();
    await expect.poll(() => log(page, "contact-end"), kPatience).toHaveLength(6);
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

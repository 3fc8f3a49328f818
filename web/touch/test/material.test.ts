// SPDX-License-Identifier: MIT
// What the page makes of material files, and of what screens say about fingers.
import { expect, test } from "vitest";
import { Finger, type FingerReport } from "../src/fingers.js";
import { parseMaterial, voiceNumbers } from "../src/material.js";
import { material } from "./site.js";

const base = "https://example.org/goods/sponge.json";

test("a material's image is beside it and its voices become numbers", () => {
  const read = parseMaterial(material(), base);
  expect(read.image).toBe("https://example.org/goods/sponge.png");
  expect(read.width_mm).toBe(80);
  expect([read.height_map, read.relief_slope, read.gloss, read.roughness]).toEqual(["", 0.2, 0.04, 0.5]);
  expect(parseMaterial(material({ height_map: "h.png" }), base).height_map).toBe("https://example.org/goods/h.png");
  expect([...voiceNumbers(read)]).toEqual([
    1, -20, 10, 10, 2, 1, 50, 1, -22, 44100, 2, -0.6, 0.2, 0, 1, 150, 1, -22, 44100, 2, -0.6, 0.2, 0,
  ]);
});

test.each<[unknown, string]>([
  [null, "file"],
  [[], "file"],
  [{}, "schema"],
  [material({ schema: "tribo.material/9" }), "schema"],
  [material({ stiffness_n_per_mm: "soft" }), "stiffness"],
  [material({ stiffness_n_per_mm: 0 }), "stiffness"],
  [material({ viscosity_n_s_per_mm: -1 }), "viscosity"],
  [material({ voices: [{ speed_mm_per_s: 1, level_db: 0, sample_rate_hz: 44100 }] }), "reflection"],
  [material({ voices: [{ speed_mm_per_s: 1, level_db: 0, sample_rate_hz: 44100, reflection: [1] }] }), "reflection"],
  [material({ image: 7 }), "image"],
  [material({ height_map: 7 }), "height_map"],
  [material({ height_map: "h.png", image: "" }), "height_map"],
  [material({ gloss: 1.5 }), "gloss"],
  [material({ gloss: null }), "gloss"],
  [material({ gloss: Number.NaN }), "gloss"],
  [material({ roughness: 0 }), "roughness"],
  [material({ relief_slope: "steep" }), "relief_slope"],
])("a wrong material is refused by its key", (json, key) => {
  expect(() => parseMaterial(json, base)).toThrow(key);
});

const report = (changes: Partial<FingerReport>) => ({
  x: 0,
  y: 0,
  width: 0,
  height: 0,
  pressure: Number.NaN,
  time: 0,
  ...changes,
});

test("force grows with time where nothing measures it, and follows pressure where something does", () => {
  const mouse = new Finger(report({}));
  expect(mouse.force(0)).toBe(0);
  expect(mouse.force(0.25)).toBeCloseTo(2 * (1 - Math.exp(-1)), 6);
  expect(mouse.force(100)).toBeCloseTo(2, 6);
  const pen = new Finger(report({ pressure: 0.5 }));
  expect(pen.force(0)).toBeCloseTo(1.5, 6);
});

test("speed is way over time, and nothing once the finger stands", () => {
  const finger = new Finger(report({}));
  for (let i = 1; i <= 20; ++i) finger.move(report({ x: 1.6 * i, time: 0.008 * i }));
  expect(finger.speed(0.16)).toBeCloseTo(200, 6);
  expect(finger.speed(0.3)).toBe(0);
});

test("what is expected next takes the lag out of speed and place", () => {
  // 400 mm/s^2: at t the finger is at 200 t^2 and moves at 400 t.
  const at = (t: number) => ({ x: 200 * t * t, y: 0, width: 0, height: 0, pressure: Number.NaN, time: t });
  const plain = new Finger(at(0));
  const led = new Finger(at(0));
  for (let t = 0.01; t < 0.3005; t += 0.01) {
    plain.move(at(t));
    led.move(at(t), at(t + 0.016));
  }
  // Over 270 to 316 ms it is 2.8 mm/s behind, over 270 to 300 ms 6 mm/s.
  expect(Math.abs(led.speed(0.3) - 120)).toBeLessThan(3);
  expect(Math.abs(plain.speed(0.3) - 120)).toBeGreaterThan(5);
  expect(Math.abs(led.contact(0.308).x - at(0.308).x)).toBeLessThan(0.05);
  expect(Math.abs(plain.contact(0.308).x - at(0.308).x)).toBeGreaterThan(0.5);
  // Not beyond what was expected.
  expect(led.contact(0.5).x).toBeCloseTo(at(0.316).x, 6);
  expect(led.speed(0.5)).toBe(0);
});

test("the contact is as large as the touch, within what a finger can be", () => {
  expect(new Finger(report({ width: 14, height: 20 })).contact(0)).toMatchObject({ halfWidth: 7, halfHeight: 10 });
  expect(new Finger(report({ width: 900, height: 0 })).contact(0)).toMatchObject({ halfWidth: 15, halfHeight: 6 });
});

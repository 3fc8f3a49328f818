// SPDX-License-Identifier: MIT
import { describe, expect, it } from "vitest";

import { liveUrl } from "../src/connection.js";
import { heat } from "../src/heat.js";
import { outline } from "../src/tool.js";

describe("heat", () => {
  const lightness = ([r, g, b]: number[]) => 0.2126 * r ** 2.2 + 0.7152 * g ** 2.2 + 0.0722 * b ** 2.2;
  it("grows lighter all the way", () => {
    for (let n = 1; n <= 40; ++n) expect(lightness(heat(n / 40))).toBeGreaterThan(lightness(heat((n - 1) / 40)));
  });
  it("stays on its scale", () => {
    expect(heat(-1)).toEqual(heat(0));
    expect(heat(2)).toEqual(heat(1));
  });
});

describe("outline", () => {
  const tool = { number: 1, flutes: 2, radius: 5, corner: 0, length: 30, holder: [{ radius: 12, length: 20 }] };
  it("of a flat end mill has a square corner and its holder", () => {
    expect(outline(tool)).toEqual([
      [0, 0],
      [5, 0],
      [5, 30],
      [12, 30],
      [12, 50],
      [0, 50],
    ]);
  });
  it("of a ball lies on the ball", () => {
    for (const [r, z] of outline({ ...tool, corner: 5, holder: [] })) {
      if (z <= 5) expect(Math.hypot(r, z - 5)).toBeCloseTo(5, 9);
    }
  });
});

describe("liveUrl", () => {
  it("is beside the page and keeps its token", () => {
    expect(liveUrl({ protocol: "http:", host: "127.0.0.1:8317", search: "" })).toBe("ws://127.0.0.1:8317/live");
    expect(liveUrl({ protocol: "https:", host: "mill", search: "?token=a%26b" })).toBe("wss://mill/live?token=a%26b");
  });
});

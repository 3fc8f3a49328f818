// SPDX-License-Identifier: MIT
// What the picture is made of, without a browser.
import { Box3, PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import type { Row } from "@tribo/protocol/frames";
import { centre, cornersOf, eyeFor } from "../src/sight/framing.js";
import { Pace } from "../src/sight/pace.js";
import { lastOf, passAt } from "../src/sight/pass.js";
import { drawnHolder } from "../src/sight/tool.js";
import { fluted, fluteSection, turned } from "../src/sight/turned.js";

describe("the flutes of a cutter", () => {
  it("reach the outline at the edge only, and have a core", () => {
    expect(fluteSection(0)).toBe(1);
    for (let n = 1; n < 200; ++n) {
      expect(fluteSection(n / 200)).toBeLessThan(1);
      expect(fluteSection(n / 200)).toBeGreaterThan(0.5);
    }
  });

  // An edge turns by tan(helix) / R per height. At a height of a quarter turn it is at the angle of 90 degrees.
  it("wind to the right by the helix angle", () => {
    const [radius, helix] = [6, Math.PI / 6];
    const quarter = ((Math.PI / 2) * radius) / Math.tan(helix);
    const position = fluted(
      [
        [radius, 0],
        [radius, quarter],
      ],
      2,
      helix,
    ).getAttribute("position");
    const edges = (z: number) => {
      const found = new Set<number>();
      for (let n = 0; n < position.count; ++n) {
        if (Math.abs(position.getZ(n) - z) > 1e-3) continue;
        const [x, y] = [position.getX(n), position.getY(n)];
        if (Math.hypot(x, y) > radius - 1e-3) found.add(Math.round((Math.atan2(y, x) * 180) / Math.PI + 360) % 180);
      }
      return [...found];
    };
    expect(edges(0)).toEqual([0]);
    expect(edges(quarter)).toEqual([90]);
  });

  it("look outwards", () => {
    const geometry = turned([
      [3, 0],
      [3, 5],
    ]);
    const [position, normal] = [geometry.getAttribute("position"), geometry.getAttribute("normal")];
    for (let n = 0; n < position.count; ++n) {
      const out = position.getX(n) * normal.getX(n) + position.getY(n) * normal.getY(n);
      expect(out).toBeGreaterThan(2.9);
    }
  });
});

describe("a holder that is only drawn", () => {
  it("is wider than the cutter above its shank", () => {
    const [shank, ...rest] = drawnHolder({ number: 1, flutes: 2, radius: 6, corner: 0, length: 40, holder: [] });
    expect(shank!.radius).toBe(6);
    for (const step of rest) expect(step.radius).toBeGreaterThan(6);
  });
});

describe("the pass at a time", () => {
  const row = (time: number, duration: number) => ({ time, duration }) as Row;
  const rows = [row(0, 1), row(1, 1), row(5, 1), row(6, 1), row(7, 1)];
  it("is what is cut without a gap up to then", () => {
    expect(passAt(rows, 1.5)).toEqual([0, 2]);
    expect(passAt(rows, 5)).toEqual([2, 3]);
    expect(passAt(rows, 7.9)).toEqual([2, 5]);
  });
  it("is nothing in the air", () => {
    for (const time of [-1, 3, 9]) {
      const [from, to] = passAt(rows, time);
      expect(to - from).toBe(0);
    }
    expect(passAt([], 1)).toEqual([0, 0]);
  });
});

describe("a pass that never ends", () => {
  it("is shown on its last piece", () => {
    const rows = Array.from({ length: 50 }, (_, n) => ({ tip: [2 * n, 0, 0] }) as unknown as Row);
    expect(lastOf(rows, [0, 50], 1000)).toEqual([0, 50]);
    expect(lastOf(rows, [0, 50], 9)).toEqual([45, 50]);
    expect(lastOf(rows, [48, 50], 9)).toEqual([48, 50]);
    expect(lastOf(rows, [7, 7], 9)).toEqual([7, 7]);
  });
});

describe("the camera", () => {
  const box = new Box3(new Vector3(-50, -40, -25), new Vector3(50, 40, 20));
  const towards = new Vector3(0.42, -0.95, 0.62).normalize();
  it.each([
    [1440, 900, { x: 280, y: 60, width: 880, height: 600 }],
    [390, 844, { x: 0, y: 50, width: 390, height: 500 }],
  ])("sees all points in the free part of a window of %i x %i", (width, height, free) => {
    const camera = new PerspectiveCamera(34, width / height, 1, 5000);
    camera.up.set(0, 0, 1);
    centre(camera, width, height, free);
    // A box, and a tool far to its left.
    const points = [...cornersOf(box), new Vector3(-80, -50, 30)];
    const share = { width: free.width / width, height: free.height / height };
    const middle = box.getCenter(new Vector3());
    const { target, distance } = eyeFor(points, middle, towards, camera, share);
    expect(target.dot(towards)).toBeCloseTo(middle.dot(towards), 9);
    camera.position.copy(target).addScaledVector(towards, distance);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    camera.updateProjectionMatrix();
    const room = [0, 1, 2, 3].map(() => Infinity);
    for (const point of points) {
      const p = point.clone().project(camera);
      const [x, y] = [((p.x + 1) * width) / 2, ((1 - p.y) * height) / 2];
      [x - free.x, free.x + free.width - x, y - free.y, free.y + free.height - y].forEach(
        (inside, side) => (room[side] = Math.min(room[side]!, inside)),
      );
    }
    expect(Math.min(...room)).toBeGreaterThan(-0.5);
    // As near as can be: it reaches from side to side, or from top to bottom.
    expect(Math.min(Math.max(room[0]!, room[1]!), Math.max(room[2]!, room[3]!))).toBeLessThan(0.5);
    // In the middle of the other way.
    expect(Math.abs(room[0]! - room[1]!)).toBeLessThan(0.3 * free.width);
  });
});

describe("the pace of pictures", () => {
  // Each asked for when the one before was drawn, or so long after it.
  const told = (time: number, count: number, rest = 0) => {
    let slow = 0;
    const pace = new Pace(() => ++slow);
    for (let n = 0; n < count; ++n) {
      pace.asked(n * (time + rest));
      pace.drawn(n * (time + rest) + time);
    }
    return slow;
  };
  it("is called slow once, where pictures take long", () => {
    expect(told(80, 200)).toBe(1);
    expect(told(16, 200)).toBe(0);
    // A picture now and then says nothing.
    expect(told(16, 200, 2000)).toBe(0);
    // Of pictures that take seconds a few are enough.
    expect(told(2000, 6)).toBe(1);
    // One that takes long is no pace: its shaders were made, or the window was hidden.
    let slow = 0;
    const pace = new Pace(() => ++slow);
    for (let n = 0, now = 0; n < 100; ++n) {
      pace.asked(now);
      now += n === 3 ? 9000 : 16;
      pace.drawn(now);
    }
    expect(slow).toBe(0);
  });
});

// SPDX-License-Identifier: MIT
// Mouse, touch, pen and keys on the part: one pointer rotates it, two shift and zoom it.

import type { Camera } from "./part_camera.js";

const TURN_PER_PX = 0.008;
const TURN_PER_KEY = 0.12;
const SHIFT_PER_KEY = 30;
const NEARER_PER_KEY = 1.2;
const NEARER_PER_WHEEL = 0.0015;

const STEPS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

interface Place {
  x: number;
  y: number;
}

export function listenToHands(canvas: HTMLCanvasElement, camera: Camera, redraw: () => void): void {
  const down = new Map<number, Place>();
  const between = () => {
    const [a, b] = [...down.values()] as [Place, Place];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  const shift = (dx: number, dy: number) => camera.shift(dx, dy, canvas.clientWidth, canvas.clientHeight);

  canvas.addEventListener("pointerdown", (e) => {
    down.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", (e) => {
    const before = down.get(e.pointerId);
    if (!before) return;
    const two = down.size === 2 ? between() : undefined;
    const dx = e.offsetX - before.x;
    const dy = e.offsetY - before.y;
    down.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    if (two) {
      const now = between();
      shift(now.x - two.x, now.y - two.y);
      if (two.apart > 0) camera.nearer(now.apart / two.apart);
    } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) {
      shift(dx, dy);
    } else if (down.size === 1) {
      camera.turnBy(TURN_PER_PX * dx, TURN_PER_PX * dy);
    }
    redraw();
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
    canvas.addEventListener(end, (e) => down.delete(e.pointerId));
  }
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  // The wheel scrolls the page until the view is clicked.
  canvas.addEventListener(
    "wheel",
    (e) => {
      if (document.activeElement !== canvas && !e.ctrlKey) return;
      e.preventDefault();
      camera.nearer(Math.exp(-NEARER_PER_WHEEL * e.deltaY));
      redraw();
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", () => {
    camera.home();
    redraw();
  });
  canvas.addEventListener("keydown", (e) => {
    const step = STEPS[e.key];
    if (step && e.shiftKey) shift(SHIFT_PER_KEY * step[0], SHIFT_PER_KEY * step[1]);
    else if (step) camera.turnBy(TURN_PER_KEY * step[0], TURN_PER_KEY * step[1]);
    else if (e.key === "+" || e.key === "=") camera.nearer(NEARER_PER_KEY);
    else if (e.key === "-") camera.nearer(1 / NEARER_PER_KEY);
    else if (e.key === "Home") camera.home();
    else return;
    e.preventDefault();
    redraw();
  });
}

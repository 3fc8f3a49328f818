// SPDX-License-Identifier: MIT
// Keyboard commands while the picture has the focus, and their list.

import { element } from "@tribo/ui/dom";
import type { Finger } from "../touch/finger.js";
import type { Scene } from "../sight/scene.js";

const TURN = 0.1;
const NEARER = 0.9;

export interface KeyActions {
  play(): void;
  mute(): void;
  feel(): void;
  seek(seconds: number): void;
  nextProblem(): void;
  loop(): void;
}

export function listenToKeys(scene: Scene, finger: Finger, actions: KeyActions): void {
  scene.canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrows: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) finger.nudge(...arrow);
    else if (arrow) scene.orbit(TURN * arrow[0], TURN * arrow[1]);
    else if (event.key === " ") actions.play();
    else if (event.key === "m" || event.key === "M") actions.mute();
    else if (event.key === "f" || event.key === "F") actions.feel();
    else if (event.key === "n" || event.key === "N") actions.nextProblem();
    else if (event.key === "l" || event.key === "L") actions.loop();
    else if (event.key === "+" || event.key === "=") scene.orbit(0, 0, NEARER);
    else if (event.key === "-") scene.orbit(0, 0, 1 / NEARER);
    else if (event.key === "," || event.key === "PageUp") actions.seek(-1);
    else if (event.key === "." || event.key === "PageDown") actions.seek(1);
    else if (event.key === "Home") scene.fit();
    else return;
    event.preventDefault();
  });
  scene.canvas.addEventListener("keyup", (event) => {
    if (event.key === "Shift") finger.lift();
  });
  scene.canvas.addEventListener("blur", () => finger.lift());
  const keys = element<HTMLDialogElement>("keys");
  element("show-keys").addEventListener("click", () => keys.showModal());
  addEventListener("keydown", ({ key, target }) => {
    const writes = target instanceof HTMLElement && target.matches("input[type=number], textarea");
    if (key === "?" && !writes && !keys.open) keys.showModal();
  });
}

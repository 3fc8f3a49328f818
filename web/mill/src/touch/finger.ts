// SPDX-License-Identifier: MIT
// The finger: mouse, touch or pen on the part, a gamepad, or keys. A drag turns the camera; a long press, a press of a pen,
// and with `atOnce` any press, presses into the part. A hovering pointer is above it.

import { oncePerFrame } from "@tribo/ui/frame";
import { rumble } from "@tribo/ui/gamepad";
import type { Scene } from "../sight/scene.js";
import type { Source } from "../sources/source.js";
import { vec3, type Vec3 } from "@tribo/protocol/vec3";

// Depth of a press and height of hovering, as shares of the part size.
const PRESS = 0.012;
const HOVER = 0.01;
const GAMEPAD_DEADZONE = 0.15;
// A press that rests this long feels, if it moves no farther than this, CSS pixels: a drag turns the camera.
const LONG_PRESS_MS = 350;
const STILL_PX = 6;

type Press = Pick<PointerEvent, "pointerId" | "offsetX" | "offsetY" | "pressure">;

export class Finger {
  enabled = false;
  // Every press on the part feels.
  atOnce = false;
  // An arm moves the finger itself.
  arm = false;
  private down: number | undefined;
  // A press that may become a long one.
  private resting: Press | undefined;
  private at: Vec3 | undefined;
  private keys = false;
  private padDown = false;
  private pressing = false;
  // Pointers move more often than pictures come.
  private readonly tellNext = oncePerFrame(() => {
    if (this.at) this.source()?.send({ op: "finger", position_mm: this.at, down: this.pressing });
  });

  constructor(
    private readonly scene: Scene,
    private readonly source: () => Source | undefined,
  ) {
    const { canvas } = scene;
    // Before the listeners of the camera: a press that feels does not turn it.
    canvas.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    for (const kind of ["pointerup", "pointercancel"] as const)
      canvas.addEventListener(kind, (event) => this.release(event), { capture: true });
    canvas.addEventListener("pointerleave", () => {
      if (this.down === undefined && !this.keys) this.leave();
    });
    // A long press asks for a menu on some systems.
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  get touching(): boolean {
    return this.down !== undefined || this.keys || this.padDown;
  }

  // By keys: Shift and arrows move the finger in the plane of the picture.
  nudge(right: number, up: number): void {
    if (!this.enabled || !this.scene.job) return;
    this.keys = true;
    this.shift(right, up, true);
  }
  lift(): void {
    if (!this.keys) return;
    this.keys = false;
    this.leave();
  }

  // From a controller in VR: a position in the frame of the part.
  place(at: Vec3, down: boolean): void {
    if (this.enabled) this.tell(at, down);
  }

  // Called once per picture: the left stick of the first gamepad moves the finger, its right trigger presses.
  pollGamepad(): void {
    const pad = navigator.getGamepads?.().find((g) => g?.connected);
    if (!pad || !this.enabled || !this.scene.job) return;
    const [x, y] = [beyondDeadZone(pad.axes[0]), beyondDeadZone(pad.axes[1])];
    const pressed = (pad.buttons[7]?.value ?? pad.buttons[0]?.value ?? 0) > 0.1;
    if (x !== 0 || y !== 0 || pressed !== this.padDown) {
      this.padDown = pressed;
      this.shift(0.4 * x, -0.4 * y, pressed);
    }
  }

  // Plays the force on the hand as rumble, if a gamepad supports it.
  rumble(force: number, limit: number): void {
    if (!this.padDown) return;
    const pad = navigator.getGamepads?.().find((g) => g?.connected);
    const strength = Math.min(force / Math.max(limit, 1e-6), 1);
    rumble(pad ?? null, 60, strength, strength);
  }

  private press(event: PointerEvent): void {
    // A second finger pinches.
    this.resting = undefined;
    if (!this.enabled || this.arm || event.button !== 0 || !event.isPrimary || this.down !== undefined) return;
    if (!this.scene.pick(event.offsetX, event.offsetY)) return;
    const press = pressOf(event);
    // A pen is held to act on what it points at, by its pressure.
    if (this.atOnce || event.pointerType === "pen") this.feel(press);
    else this.rest(press);
  }

  private rest(press: Press): void {
    this.resting = press;
    const feel = () => {
      if (this.resting === press) this.feel(press);
    };
    // With the next picture: a slow page may not have heard of a move yet.
    setTimeout(() => requestAnimationFrame(feel), LONG_PRESS_MS);
  }

  private feel(press: Press): void {
    this.resting = undefined;
    if (!this.enabled) return;
    this.down = press.pointerId;
    // Also in a drag that the camera has begun to follow.
    this.scene.controls.enabled = false;
    this.scene.canvas.setPointerCapture(press.pointerId);
    this.scene.canvas.classList.add("touching");
    this.follow(press);
  }

  private move(event: PointerEvent): void {
    if (!this.enabled || this.arm) return;
    if (this.resting) {
      const { offsetX, offsetY } = this.resting;
      if (Math.hypot(event.offsetX - offsetX, event.offsetY - offsetY) <= STILL_PX) return;
      this.resting = undefined;
      this.leave();
    }
    if (this.down === undefined) {
      if (event.pointerType === "touch" || event.buttons !== 0) return;
      const hit = this.scene.pick(event.offsetX, event.offsetY);
      if (hit) this.tell(along(hit.point, hit.normal, HOVER * this.scene.extent()), true);
      else this.leave();
      return;
    }
    if (event.pointerId === this.down) this.follow(event);
  }

  private follow({ offsetX, offsetY, pressure }: Press): void {
    const hit = this.scene.pick(offsetX, offsetY);
    if (!hit) return;
    // A pen reports its pressure, which sets the depth; a mouse reports 0.5.
    const depth = PRESS * this.scene.extent() * (pressure > 0 ? 2 * pressure : 1);
    this.tell(along(hit.point, hit.normal, -depth), true);
  }

  private release(event: PointerEvent): void {
    if (event.pointerId === this.resting?.pointerId) this.resting = undefined;
    if (event.pointerId !== this.down) return;
    this.down = undefined;
    this.scene.controls.enabled = true;
    this.scene.canvas.classList.remove("touching");
    this.leave();
  }

  private leave(): void {
    if (!this.at) return;
    this.source()?.send({ op: "finger", position_mm: this.at, down: false });
    this.at = undefined;
  }

  private shift(right: number, up: number, down: boolean): void {
    const job = this.scene.job!;
    const step = 0.02 * this.scene.extent();
    const start: Vec3 = this.at ?? vec3((k) => (job.blank.min[k] + job.blank.max[k]) / 2);
    const m = this.scene.camera.matrixWorld.elements;
    // Directions to the right and away from the eye, in the table plane.
    const side = flat([m[0], m[1], 0]);
    const ahead = flat([-m[8] + m[4], -m[9] + m[5], 0]);
    const next = vec3((k) => start[k] + step * (right * side[k] + up * ahead[k]));
    for (const k of [0, 1] as const) next[k] = Math.min(Math.max(next[k], job.blank.min[k]), job.blank.max[k]);
    // The part stops the finger; it presses from above.
    next[2] = down ? (job.blank.min[2] + job.blank.max[2]) / 2 : job.blank.max[2] + HOVER * this.scene.extent();
    const top = this.scene.surfaceBelow(next[0], next[1]);
    if (top !== undefined) next[2] = top + (down ? -PRESS : HOVER) * this.scene.extent();
    this.tell(next, down);
  }

  private tell(at: Vec3, down: boolean): void {
    this.at = at;
    this.pressing = down;
    this.tellNext();
  }
}

// An event loses its place on the canvas once it is handled.
function pressOf({ pointerId, offsetX, offsetY, pressure }: PointerEvent): Press {
  return { pointerId, offsetX, offsetY, pressure };
}
function beyondDeadZone(deflection = 0): number {
  return Math.abs(deflection) < GAMEPAD_DEADZONE ? 0 : deflection;
}
function along(p: Vec3, direction: Vec3, by: number): Vec3 {
  return [p[0] + by * direction[0], p[1] + by * direction[1], p[2] + by * direction[2]];
}
function flat(v: Vec3): Vec3 {
  const size = Math.hypot(v[0], v[1]) || 1;
  return [v[0] / size, v[1] / size, 0];
}

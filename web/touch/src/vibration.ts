// SPDX-License-Identifier: MIT
// What a device can shake: navigator.vibrate (phones with Chromium) and a gamepad's actuator. A rub is short
// pulses, one every few millimetres, stronger and denser the faster and firmer it is.
import { rumble } from "@tribo/ui/gamepad";

const kMillimetresPerPulse = 4;
const kLeastPauseS = 0.03;
const kLongestPulseMs = 12;

export class Vibration {
  #way = 0;
  #last = 0;

  /** Call once a frame while touched; speed in mm/s, force in N. */
  rub(speed: number, force: number, seconds: number, now: number): void {
    this.#way += speed * seconds;
    if (this.#way < kMillimetresPerPulse || now - this.#last < kLeastPauseS) return;
    this.#way = 0;
    this.#last = now;
    const strength = Math.min(1, force / 2);
    // Refused without a gesture, and where vibration is off.
    navigator.vibrate?.(Math.max(2, Math.round(kLongestPulseMs * strength)));
    for (const pad of navigator.getGamepads?.() ?? []) rumble(pad, 2 * kLongestPulseMs, strength, 0);
  }
}

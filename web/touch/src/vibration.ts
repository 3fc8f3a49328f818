// SPDX-License-Identifier: MIT
// Vibration of the device: navigator.vibrate (phones with Chromium) and the actuator of a gamepad. A rub gives short
// pulses, one every few millimetres. They are stronger and denser if the rub is faster and firmer.
import { rumble } from "@tribo/ui/gamepad";

const kMillimetresPerPulse = 4;
const kLeastPauseS = 0.03;
const kLongestPulseMs = 12;

export class Vibration {
  #way = 0;
  #last = 0;

  /** Called once per frame during a touch; speed in mm/s, force in N. */
  rub(speed: number, force: number, seconds: number, now: number): void {
    this.#way += speed * seconds;
    if (this.#way < kMillimetresPerPulse || now - this.#last < kLeastPauseS) return;
    this.#way = 0;
    this.#last = now;
    const strength = Math.min(1, force / 2);
    // The browser refuses it without a gesture, or if vibration is off.
    navigator.vibrate?.(Math.max(2, Math.round(kLongestPulseMs * strength)));
    for (const pad of navigator.getGamepads?.() ?? []) rumble(pad, 2 * kLongestPulseMs, strength, 0);
  }
}

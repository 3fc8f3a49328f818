// SPDX-License-Identifier: MIT

/** Magnitudes 0 to 1: of the fast, weak motor and of the slow, strong one. */
export function rumble(pad: Gamepad | null, ms: number, weak: number, strong: number): void {
  // Without a gesture the browser refuses; this is harmless.
  void pad?.vibrationActuator
    ?.playEffect("dual-rumble", { duration: ms, weakMagnitude: weak, strongMagnitude: strong })
    .catch(() => undefined);
}

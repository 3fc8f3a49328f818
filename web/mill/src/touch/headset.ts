// SPDX-License-Identifier: MIT
// The button of VR, where there is a headset. What VR needs is loaded when it is entered.

import type { FingerFrame } from "@tribo/protocol/frames";
import { element } from "@tribo/ui/dom";
import type { Scene } from "../sight/scene.js";
import type { Finger } from "./finger.js";
import type { Headset } from "./xr.js";

let headset: Headset | undefined;

export function listenToHeadset(
  scene: Scene,
  finger: Finger,
  { hear, play }: { hear: () => Promise<void>; play: () => void },
): void {
  void navigator.xr?.isSessionSupported("immersive-vr").then((can) => {
    const button = element("vr");
    button.hidden = !can;
    button.addEventListener("click", async () => {
      void hear();
      const loaded = await import("./xr.js");
      headset ??= new loaded.Headset(scene, finger, play);
      await headset.enter();
    });
  });
}

/** Plays the force on the controllers, in VR. */
export function pulseHeadset(frame: FingerFrame): void {
  headset?.pulse(frame);
}

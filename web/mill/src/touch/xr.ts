// SPDX-License-Identifier: MIT
// VR: the part at its true size on a bench, the right controller as the finger, and pulses from the force.

import { BoxGeometry, Color, Group, Mesh, MeshStandardMaterial, Vector3, type XRTargetRaySpace } from "three";

import type { FingerFrame } from "@tribo/protocol/frames";
import type { Finger } from "./finger.js";
import type { Scene } from "../sight/scene.js";

const BENCH_HEIGHT_M = 0.95;
const BENCH_AWAY_M = 0.5;
const MM = 0.001;
// Force of the strongest pulse, in newtons.
const FULL_N = 3;
const PULSE_MS = 24;

export class Headset {
  private readonly bench = new Group();
  private session: XRSession | undefined;
  private readonly hands: XRTargetRaySpace[] = [];

  constructor(
    private readonly scene: Scene,
    private readonly finger: Finger,
    private readonly play: () => void,
  ) {
    const top = new Mesh(
      new BoxGeometry(1.2, 0.04, 0.7),
      new MeshStandardMaterial({ color: 0x5d4a3a, roughness: 0.8 }),
    );
    top.position.y = -0.02;
    this.bench.add(top);
    this.bench.position.set(0, BENCH_HEIGHT_M, -BENCH_AWAY_M);
  }

  async enter(): Promise<void> {
    const { renderer, three, world, job } = this.scene;
    if (!job || !navigator.xr) return;
    const session = await navigator.xr.requestSession("immersive-vr", { optionalFeatures: ["local-floor"] });
    this.session = session;
    renderer.xr.enabled = true;
    await renderer.xr.setSession(session);
    const background = three.background;
    three.background = new Color(0x1c222b);
    // z is up in the stock, y in a headset.
    const { min, max } = job.blank;
    world.scale.setScalar(MM);
    world.rotation.x = -Math.PI / 2;
    world.position.set(-MM * 0.5 * (min[0] + max[0]), -MM * min[2], MM * 0.5 * (min[1] + max[1]));
    this.bench.add(world);
    three.add(this.bench);
    for (const n of [0, 1]) {
      const hand = renderer.xr.getController(n);
      hand.addEventListener("squeezestart", () => this.play());
      this.hands.push(hand);
      three.add(hand);
    }
    renderer.setAnimationLoop(() => {
      this.feel();
      this.scene.render();
    });
    session.addEventListener("end", () => {
      renderer.setAnimationLoop(null);
      renderer.xr.enabled = false;
      three.background = background;
      for (const hand of this.hands.splice(0)) three.remove(hand);
      three.remove(this.bench);
      world.scale.setScalar(1);
      world.rotation.set(0, 0, 0);
      world.position.set(0, 0, 0);
      three.add(world);
      this.session = undefined;
      this.scene.draw();
    });
  }

  // Plays the force on the finger on the controllers.
  pulse(frame: FingerFrame): void {
    if (!this.session || !frame.contact) return;
    const strength = Math.min(Math.hypot(...frame.force) / FULL_N, 1);
    if (strength < 0.02) return;
    for (const source of this.session.inputSources) {
      const [actuator] =
        (source.gamepad as unknown as { hapticActuators?: { pulse(s: number, ms: number): Promise<boolean> }[] })
          ?.hapticActuators ?? [];
      void actuator?.pulse(strength, PULSE_MS);
    }
  }

  // The finger is slightly in front of the controller. The trigger has no effect: the finger touches where it is.
  private feel(): void {
    const hand = this.hands.find((h) => h.visible);
    if (!hand) return;
    const tip = new Vector3(0, 0, -0.05).applyMatrix4(hand.matrixWorld);
    const at = this.scene.world.worldToLocal(tip);
    this.finger.place([at.x, at.y, at.z], true);
  }
}

// SPDX-License-Identifier: MIT
// The stock in the picture while it is set up: its edges, and a handle on each face that is dragged along its axis.

import {
  BoxGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";

import type { Scene } from "../sight/scene.js";
import { fromField, toField } from "../texts/figures.js";
import { FACES, middleOf, moved, nearestOnAxis, stepFor, type Box, type Face } from "./stock_box.js";

const COLOUR = 0x2f7fd6;
// Radius of a handle in sizes of the box, and how near a pointer must be, CSS pixels.
const RADIUS = 0.016;
const REACH_PX = 22;

export class StockHandles {
  private readonly group = new Group();
  private readonly edges = new LineSegments(
    new EdgesGeometry(new BoxGeometry()),
    new LineBasicMaterial({ color: COLOUR }),
  );
  private readonly handles: Mesh[];
  private box: Box | undefined;
  private held: { face: Face; pointer: number } | undefined;

  /** `changed` gets the box while it is dragged, and `done` at the end. */
  constructor(
    private readonly scene: Scene,
    private readonly changed: (box: Box, done: boolean) => void,
  ) {
    const ball = new SphereGeometry(1, 20, 14);
    const material = new MeshBasicMaterial({ color: COLOUR, depthTest: false, transparent: true, opacity: 0.9 });
    this.handles = FACES.map(() => new Mesh(ball, material));
    for (const handle of this.handles) handle.renderOrder = 4;
    this.group.add(this.edges, ...this.handles);
    this.group.visible = false;
    scene.world.add(this.group);
    // Around the canvas, so that a handle comes before finger and camera.
    const around = scene.canvas.parentElement!;
    const before = { capture: true };
    around.addEventListener("pointerdown", (event) => this.press(event), before);
    around.addEventListener("pointermove", (event) => this.move(event), before);
    for (const kind of ["pointerup", "pointercancel"] as const)
      around.addEventListener(kind, (event) => this.release(event), before);
  }

  /** Undefined: there is no box to set up. */
  show(box: Box | undefined): void {
    this.box = box;
    this.group.visible = box !== undefined;
    if (box) {
      const [low, high] = box.map((corner) => new Vector3(...corner)) as [Vector3, Vector3];
      this.edges.position.copy(low).add(high).multiplyScalar(0.5);
      this.edges.scale.copy(high).sub(low);
      const size = this.edges.scale.length();
      FACES.forEach((face, n) => {
        this.handles[n]!.position.set(...middleOf(box, face));
        this.handles[n]!.scale.setScalar(RADIUS * size);
      });
    }
    this.scene.draw();
  }

  /** Where the handle of a face is, CSS pixels from the corner of the canvas. */
  placeOf(face: Face): { x: number; y: number } {
    const { canvas, camera } = this.scene;
    const seen = this.handles[FACES.indexOf(face)]!.position.clone().project(camera);
    return { x: ((seen.x + 1) / 2) * canvas.clientWidth, y: ((1 - seen.y) / 2) * canvas.clientHeight };
  }

  private near({ offsetX, offsetY }: PointerEvent): Face | undefined {
    // A place that is measured may lie below a handle.
    if (!this.box || this.scene.canvas.classList.contains("measuring")) return undefined;
    let [best, least]: [Face | undefined, number] = [undefined, REACH_PX];
    for (const face of FACES) {
      const { x, y } = this.placeOf(face);
      const away = Math.hypot(x - offsetX, y - offsetY);
      if (away < least) [best, least] = [face, away];
    }
    return best;
  }

  private press(event: PointerEvent): void {
    if (event.target !== this.scene.canvas || event.button !== 0) return;
    const face = this.near(event);
    if (!face) return;
    event.stopPropagation();
    this.held = { face, pointer: event.pointerId };
    this.scene.canvas.setPointerCapture(event.pointerId);
  }

  private move(event: PointerEvent): void {
    const { held, box } = this;
    const { canvas } = this.scene;
    if (!held) {
      canvas.classList.toggle("on-handle", event.target === canvas && this.near(event) !== undefined);
      return;
    }
    if (!box || event.pointerId !== held.pointer) return;
    event.stopPropagation();
    const { origin, direction } = this.scene.rayAt(event.offsetX, event.offsetY);
    const { axis } = held.face;
    const at = nearestOnAxis(origin.toArray(), direction.toArray(), middleOf(box, held.face), axis);
    if (at === undefined) return;
    // Round in the unit of the user.
    const step = stepFor(Number(toField(this.edges.scale.length())));
    const round = fromField(Number((Math.round(Number(toField(at)) / step) * step).toPrecision(9)));
    const next = moved(box, held.face, round, fromField(step));
    this.show(next);
    this.changed(next, false);
  }

  private release(event: PointerEvent): void {
    if (event.pointerId !== this.held?.pointer) return;
    event.stopPropagation();
    this.held = undefined;
    if (this.box) this.changed(this.box, true);
  }
}

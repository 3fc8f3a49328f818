// SPDX-License-Identifier: MIT
// Objects drawn over the part: the force as an arrow, the finger and its proxy, the eight textured triangles with
// their force vectors (figures 3 and 5 of the milling paper), a measured distance, a marked place.

import {
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";

import { Arrow } from "./arrow.js";
import type { FingerFrame, StateFrame, TextureFrame } from "@tribo/protocol/frames";
import type { Palette } from "./palette.js";
import { vec3, type Vec3 } from "@tribo/protocol/vec3";

const UP = new Vector3(0, 0, 1);

export class Overlays {
  readonly group = new Group();
  arrowVisible = false;
  private size = 1;
  private largest = 1;
  private readonly force: Arrow;
  private readonly finger = new Group();
  private readonly solid: MeshStandardMaterial;
  private readonly ghost: MeshStandardMaterial;
  private readonly skin: Mesh;
  private readonly hand: Mesh;
  private readonly strain: Line;
  private readonly felt: Arrow;
  private readonly texture = new Group();
  private readonly measure = new Group();
  private readonly mark: Mesh;

  constructor(palette: Palette) {
    this.force = new Arrow(palette.force);
    this.felt = new Arrow(palette.finger);
    this.solid = new MeshStandardMaterial({ color: palette.finger, roughness: 0.45 });
    this.ghost = new MeshStandardMaterial({
      color: palette.finger,
      transparent: true,
      opacity: 0.28,
      depthWrite: false,
    });
    const shape = new CylinderGeometry(1, 1, 5, 32).rotateX(Math.PI / 2).translate(0, 0, 2.5);
    this.skin = new Mesh(shape, this.solid);
    this.hand = new Mesh(shape, this.ghost);
    this.strain = line(palette.finger);
    this.mark = new Mesh(
      new SphereGeometry(1, 24, 16),
      // Seen through the tool, which stands there.
      new MeshBasicMaterial({ color: palette.force, transparent: true, opacity: 0.7, depthTest: false }),
    );
    this.mark.renderOrder = 2;
    this.finger.add(this.skin, this.hand, this.strain, this.felt);
    this.group.add(this.force, this.finger, this.texture, this.measure, this.mark);
    for (const part of [this.force, this.finger, this.mark]) part.visible = false;
  }

  begin(size: number): void {
    this.size = size;
    this.largest = 1;
    for (const part of [this.force, this.finger, this.mark]) part.visible = false;
    this.texture.clear();
    this.setMeasure([]);
  }

  setPalette(palette: Palette): void {
    this.force.setColor(palette.force);
    this.felt.setColor(palette.finger);
    this.solid.color.set(palette.finger);
    this.ghost.color.set(palette.finger);
    (this.strain.material as LineBasicMaterial).color.set(palette.finger);
  }

  showForce(state: StateFrame): void {
    const size = Math.hypot(...state.force);
    this.largest = Math.max(this.largest, size);
    this.force.visible = this.arrowVisible && state.cutting && size > 0;
    if (this.force.visible) this.force.point(state.tip, state.force, 0.25 * this.size, this.largest);
  }

  // Opaque at the position allowed by the part, transparent at the position of the hand.
  showFinger(finger: FingerFrame): void {
    const radius = 0.022 * this.size;
    const away = new Vector3(...finger.force);
    const up = finger.contact && away.length() > 0 ? away.normalize() : UP;
    const turn = new Quaternion().setFromUnitVectors(UP, UP.clone().lerp(up, 0.5).normalize());
    const place = (mesh: Mesh, at: Vec3) => {
      mesh.position.set(...at);
      mesh.quaternion.copy(turn);
      mesh.scale.setScalar(radius);
    };
    place(this.skin, finger.contact ? finger.proxy : finger.hand);
    place(this.hand, finger.hand);
    this.hand.visible = finger.contact;
    this.finger.visible = true;
    this.strain.visible = finger.contact;
    setPoints(this.strain, [finger.hand, finger.proxy]);
    this.felt.visible = finger.contact && Math.hypot(...finger.force) > 0.01;
    if (this.felt.visible) this.felt.point(finger.proxy, finger.force, 0.2 * this.size, 3);
  }
  hideFinger(): void {
    this.finger.visible = false;
  }

  showTexture(frame: TextureFrame): void {
    for (const child of this.texture.children as Mesh[]) child.geometry?.dispose();
    this.texture.clear();
    const most = Math.max(...frame.triangles.map((t) => Math.hypot(...t.force)), 1e-9);
    frame.triangles.forEach(({ corners, force }, n) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flat()), 3));
      const shade = n % 2 === 0 ? 0xffffff : 0x9fc2ee;
      const face = new MeshBasicMaterial({
        color: shade,
        transparent: true,
        opacity: 0.55,
        side: DoubleSide,
        depthTest: false,
      });
      const centre = vec3((k) => (corners[0][k] + corners[1][k] + corners[2][k]) / 3);
      const arrow = new Arrow(0xffffff);
      arrow.visible = Math.hypot(...force) > 1e-6;
      if (arrow.visible) arrow.point(centre, force, 0.08 * this.size, most);
      this.texture.add(new Mesh(geometry, face), arrow);
    });
  }

  setMeasure(points: Vec3[]): void {
    for (const child of this.measure.children as (Mesh | Line)[]) child.geometry.dispose();
    this.measure.clear();
    for (const p of points) {
      const dot = new Mesh(
        new SphereGeometry(0.006 * this.size, 16, 12),
        new MeshBasicMaterial({ color: 0x111111, depthTest: false }),
      );
      dot.position.set(...p);
      dot.renderOrder = 2;
      this.measure.add(dot);
    }
    if (points.length === 2) {
      const between = line(0x111111);
      (between.material as LineBasicMaterial).depthTest = false;
      setPoints(between, points);
      this.measure.add(between);
    }
  }

  // A place to inspect: a collision.
  setMark(at: Vec3 | undefined): void {
    this.mark.visible = at !== undefined;
    if (at) this.mark.position.set(...at);
    this.mark.scale.setScalar(0.02 * this.size);
  }
}

function line(colour: number): Line {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(6), 3));
  const made = new Line(geometry, new LineBasicMaterial({ color: colour }));
  made.frustumCulled = false;
  return made;
}

function setPoints(target: Line, points: Vec3[]): void {
  const position = target.geometry.getAttribute("position") as BufferAttribute;
  points.forEach((p, n) => position.setXYZ(n, ...p));
  position.needsUpdate = true;
}

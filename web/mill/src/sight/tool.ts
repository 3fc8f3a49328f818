// SPDX-License-Identifier: MIT
// The tool and its latest positions (figure 2 of the milling paper).

import {
  Color,
  Group,
  InstancedMesh,
  LatheGeometry,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Quaternion,
  Vector2,
  Vector3,
} from "three";

import type { Cutter, StateFrame } from "@tribo/protocol/frames";

const CORNER_STEPS = 12;
const POSITIONS = 10;
const UP = new Vector3(0, 0, 1);

// Points (radius, height above the tip) from the bottom of the axis to its top.
export function outline(cutter: Cutter): [number, number][] {
  const { radius, corner, length, holder } = cutter;
  const points: [number, number][] = [[0, 0]];
  if (cutter.outline) {
    points.push(...cutter.outline.filter(([, height]) => height <= length));
    points.push([points[points.length - 1]![0], length]);
  } else {
    for (let n = corner > 0 ? 0 : CORNER_STEPS; n <= CORNER_STEPS; ++n) {
      const a = (n / CORNER_STEPS) * (Math.PI / 2);
      points.push([radius - corner + corner * Math.sin(a), corner - corner * Math.cos(a)]);
    }
    points.push([radius, length]);
  }
  let z = length;
  for (const step of holder) {
    points.push([step.radius, z], [step.radius, z + step.length]);
    z += step.length;
  }
  points.push([0, z]);
  return points;
}

function lathe(cutter: Cutter, segments: number): LatheGeometry {
  return new LatheGeometry(
    outline(cutter).map(([r, z]) => new Vector2(r, z)),
    segments,
  ).rotateX(Math.PI / 2);
}

export class Tool {
  readonly group = new Group();
  private readonly tools: Mesh[] = [];
  private readonly steel: MeshStandardMaterial;
  private readonly ghost: MeshStandardMaterial;
  private readonly rows: InstancedMesh[] = [];
  private cutters: Cutter[] = [];
  private shown = 0;
  private last = new Vector3(Infinity, 0, 0);
  private next = 0;

  constructor(colour: number) {
    this.steel = new MeshStandardMaterial({ color: colour, metalness: 0.35, roughness: 0.35, flatShading: false });
    this.steel.transparent = true;
    this.steel.opacity = 0.88;
    this.ghost = new MeshStandardMaterial({ color: colour, transparent: true, opacity: 0.13, depthWrite: false });
  }

  setColour(colour: number): void {
    for (const material of [this.steel, this.ghost]) material.color = new Color(colour);
  }

  set positionsVisible(on: boolean) {
    this.rows.forEach((row) => (row.userData.on = on));
    this.choose();
  }

  begin(cutters: Cutter[]): void {
    for (const mesh of [...this.tools, ...this.rows]) mesh.geometry.dispose();
    this.tools.length = 0;
    this.rows.length = 0;
    this.group.clear();
    this.cutters = cutters;
    this.next = 0;
    this.last.set(Infinity, 0, 0);
    for (const cutter of cutters) {
      const mesh = new Mesh(lathe(cutter, 40), this.steel);
      // Only the cutting part.
      const row = new InstancedMesh(
        lathe({ ...cutter, length: Math.min(cutter.length, 2.2 * cutter.radius), holder: [] }, 20),
        this.ghost,
        POSITIONS,
      );
      row.count = 0;
      row.frustumCulled = false;
      row.userData.on = true;
      this.tools.push(mesh);
      this.rows.push(row);
      this.group.add(mesh, row);
    }
    this.choose();
  }

  show(state: StateFrame): void {
    const turn = new Quaternion().setFromUnitVectors(UP, new Vector3(...state.axis).normalize());
    if (state.cutter !== this.shown) this.next = 0;
    this.shown = state.cutter;
    const tool = this.tools[state.cutter];
    if (!tool) return;
    tool.position.set(...state.tip);
    tool.quaternion.copy(turn).multiply(new Quaternion().setFromAxisAngle(UP, -state.angle));
    const row = this.rows[state.cutter]!;
    if (this.last.distanceTo(tool.position) > this.cutters[state.cutter]!.radius) {
      this.last.copy(tool.position);
      if (state.cutting) {
        row.setMatrixAt(this.next % POSITIONS, new Matrix4().compose(tool.position, turn, new Vector3(1, 1, 1)));
        row.instanceMatrix.needsUpdate = true;
        row.count = Math.min(++this.next, POSITIONS);
      }
    }
    this.choose();
  }

  private choose(): void {
    this.tools.forEach((mesh, n) => (mesh.visible = n === this.shown));
    this.rows.forEach((row, n) => (row.visible = n === this.shown && row.userData.on));
  }
}

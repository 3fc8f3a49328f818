// SPDX-License-Identifier: MIT
// The tool with its flutes and its holder, and its latest positions (figure 2 of the milling paper).

import {
  Box3,
  type BufferGeometry,
  Color,
  Group,
  InstancedMesh,
  type Material,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Quaternion,
  Vector3,
} from "three";

import type { Cutter, StateFrame } from "@tribo/protocol/frames";
import { CONTACT_LAYER } from "./contact.js";
import { fluted, turned, type Outline } from "./turned.js";

const CORNER_STEPS = 12;
const POSITIONS = 10;
const UP = new Vector3(0, 0, 1);
// More teeth a second than this pass too fast to be seen.
const SEEN_TEETH_PER_S = 12;
const HOLDER = 0x484b50;

// Points (radius, height above the tip) from the bottom of the axis to the top of the cutting part.
function cuttingPart(cutter: Cutter): Outline {
  const { radius, corner, length } = cutter;
  const points: Outline = [[0, 0]];
  if (cutter.outline) {
    points.push(...cutter.outline.filter(([, height]) => height <= length));
    points.push([points[points.length - 1]![0], length]);
    return points;
  }
  for (let n = corner > 0 ? 0 : CORNER_STEPS; n <= CORNER_STEPS; ++n) {
    const a = (n / CORNER_STEPS) * (Math.PI / 2);
    points.push([radius - corner + corner * Math.sin(a), corner - corner * Math.cos(a)]);
  }
  points.push([radius, length]);
  return points;
}

// Points of the steps above the cutting part, to the axis.
function upperPart(cutter: Cutter): Outline {
  const points: Outline = [];
  let z = cutter.length;
  for (const step of cutter.holder) {
    points.push([step.radius, z], [step.radius, z + step.length]);
    z += step.length;
  }
  points.push([0, z]);
  return points;
}

// Points (radius, height above the tip) from the bottom of the axis to its top.
export function outline(cutter: Cutter): Outline {
  return [...cuttingPart(cutter), ...upperPart(cutter)];
}

/** Steps that are drawn where the job names no holder: a shank, a nut, a collet chuck. They are not checked. */
export function drawnHolder({ radius, length }: Cutter): Cutter["holder"] {
  const nut = Math.max(1.9 * radius, radius + 6);
  return [
    { radius, length: Math.max(0.4 * length, 2 * radius) },
    { radius: nut, length: 0.8 * nut },
    { radius: 1.25 * nut, length: 2.4 * nut },
  ];
}

interface Drawn {
  group: Group;
  fluted: Mesh;
  // What is seen of a cutter that turns fast: where its edges pass, and its core.
  blur: Group;
  flutes: number;
  length: number;
}

export class Tool {
  readonly group = new Group();
  private readonly tools: Drawn[] = [];
  private readonly steel: MeshStandardMaterial;
  private readonly dark = new MeshStandardMaterial({ color: HOLDER, polygonOffset: true, polygonOffsetFactor: 1 });
  private readonly haze: MeshStandardMaterial;
  private readonly ghost: MeshStandardMaterial;
  private readonly rows: InstancedMesh[] = [];
  private cutters: Cutter[] = [];
  private helix = Math.PI / 6;
  private shown = 0;
  private last = new Vector3(Infinity, 0, 0);
  private next = 0;
  private positions = false;

  constructor(colour: number) {
    // A wall that the cutter has just left lies on it: the wall is seen.
    const behind = { polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8 };
    this.steel = new MeshStandardMaterial({ color: colour, ...behind });
    this.haze = new MeshStandardMaterial({
      color: colour,
      transparent: true,
      opacity: 0.42,
      depthWrite: false,
      ...behind,
    });
    this.ghost = new MeshStandardMaterial({ color: colour, transparent: true, opacity: 0.13, depthWrite: false });
    this.setFine(false);
  }

  setColour(colour: number): void {
    for (const material of [this.steel, this.haze, this.ghost]) material.color = new Color(colour);
  }
  setFine(fine: boolean): void {
    this.steel.metalness = this.haze.metalness = fine ? 1 : 0.35;
    this.steel.roughness = fine ? 0.24 : 0.35;
    this.haze.roughness = 0.4;
    this.dark.metalness = fine ? 0.85 : 0.2;
    this.dark.roughness = fine ? 0.32 : 0.5;
  }
  // Of the flutes, degrees.
  setHelix(degrees: number): void {
    const helix = (degrees * Math.PI) / 180;
    if (helix === this.helix) return;
    this.helix = helix;
    this.tools.forEach(({ fluted: mesh }, n) => {
      mesh.geometry.dispose();
      mesh.geometry = this.flutes(this.cutters[n]!);
    });
  }

  set positionsVisible(on: boolean) {
    this.positions = on;
    this.choose();
  }

  begin(cutters: Cutter[]): void {
    this.group.traverse((object) => {
      if (object instanceof Mesh) (object.geometry as BufferGeometry).dispose();
    });
    this.tools.length = 0;
    this.rows.length = 0;
    this.group.clear();
    this.cutters = cutters;
    this.next = 0;
    this.last.set(Infinity, 0, 0);
    for (const cutter of cutters) {
      const drawn = this.draw(cutter);
      // Only the cutting part.
      const low = { ...cutter, length: Math.min(cutter.length, 2.2 * cutter.radius), holder: [] };
      const row = new InstancedMesh(turned(outline(low)), this.ghost, POSITIONS);
      row.count = 0;
      row.frustumCulled = false;
      this.tools.push(drawn);
      this.rows.push(row);
      this.group.add(drawn.group, row);
    }
    this.choose();
  }

  show(state: StateFrame): void {
    const turn = new Quaternion().setFromUnitVectors(UP, new Vector3(...state.axis).normalize());
    if (state.cutter !== this.shown) this.next = 0;
    this.shown = state.cutter;
    const tool = this.tools[state.cutter];
    if (!tool) return;
    tool.group.position.set(...state.tip);
    tool.group.quaternion.copy(turn);
    tool.fluted.rotation.z = -state.angle;
    const fast = state.playing && (state.rpm / 60) * state.speed * tool.flutes > SEEN_TEETH_PER_S;
    tool.fluted.visible = !fast;
    tool.blur.visible = fast;
    const row = this.rows[state.cutter]!;
    if (this.last.distanceTo(tool.group.position) > this.cutters[state.cutter]!.radius) {
      this.last.copy(tool.group.position);
      if (state.cutting) {
        row.setMatrixAt(this.next % POSITIONS, new Matrix4().compose(tool.group.position, turn, new Vector3(1, 1, 1)));
        row.instanceMatrix.needsUpdate = true;
        row.count = Math.min(++this.next, POSITIONS);
      }
    }
    this.choose();
  }

  /** All of the tool where it stands, in the frame of the part. */
  box(): Box3 {
    const tool = this.tools[this.shown];
    if (!tool) return new Box3();
    tool.group.updateMatrixWorld();
    const box = new Box3().setFromObject(tool.group);
    return box.applyMatrix4(this.group.matrixWorld.clone().invert());
  }

  private draw(cutter: Cutter): Drawn {
    const group = new Group();
    const mesh = (geometry: BufferGeometry, material: Material): Mesh => {
      const part = new Mesh(geometry, material);
      part.castShadow = true;
      part.layers.enable(CONTACT_LAYER);
      return part;
    };
    const holder = cutter.holder.length > 0 ? cutter.holder : drawnHolder(cutter);
    const flutes = mesh(this.flutes(cutter), this.steel);
    const blur = new Group();
    const low = cuttingPart(cutter);
    const core = mesh(turned(low.map(([r, z]) => [0.62 * r, z])), this.steel);
    const haze = new Mesh(turned(low), this.haze);
    haze.castShadow = true;
    blur.add(core, haze);
    // A step as thin as the cutter is its shank.
    const shank = holder.filter((step) => step.radius <= 1.05 * cutter.radius);
    const rest = holder.slice(shank.length);
    const shankLength = shank.reduce((sum, step) => sum + step.length, 0);
    const tops: [Cutter["holder"], number, MeshStandardMaterial][] = [
      [shank, cutter.length, this.steel],
      [rest, cutter.length + shankLength, this.dark],
    ];
    for (const [steps, length, material] of tops) {
      if (steps.length === 0) continue;
      const upper: Outline = [[0, length], ...upperPart({ ...cutter, length, holder: steps })];
      group.add(mesh(turned(upper), material));
    }
    group.add(flutes, blur);
    return { group, fluted: flutes, blur, flutes: cutter.flutes, length: cutter.length };
  }

  private flutes(cutter: Cutter): BufferGeometry {
    return fluted([...cuttingPart(cutter), [0, cutter.length]], Math.max(cutter.flutes, 1), this.helix);
  }

  private choose(): void {
    this.tools.forEach(({ group }, n) => (group.visible = n === this.shown));
    this.rows.forEach((row, n) => (row.visible = n === this.shown && this.positions));
  }
}

// SPDX-License-Identifier: MIT
// The surface of the part in chunks, and its colours by data.

import {
  Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Group,
  type Intersection,
  Mesh,
  type Material,
  type Raycaster,
  Vector3,
} from "three";

import type { ChunkFrame, JobFrame, Row } from "@tribo/protocol/frames";
import { vec3, type Vec3 } from "@tribo/protocol/vec3";
import type { Triangles } from "../keep/triangles.js";
import { CONTACT_LAYER } from "./contact.js";
import type { Colouring, HeatMap } from "./heat_map.js";

// A point closer to a side of the blank counts as on it, in cells; of engines that do not say what is.
const ON_BLANK = 1e-3;
// The box over a part is smaller by this share of its size on each side, so that their sides do not flicker.
const INSET = 1e-3;
// A large part is coloured in pieces, ms each, and drawn at intervals, ms.
const COLOURING_MS = 8;
const SHOWN_EVERY_MS = 200;

export interface Hit {
  point: Vec3;
  normal: Vec3;
  // Distance from the designed surface there, mm; NaN: not known.
  deviation: number;
  untouched: boolean;
}

interface Chunk {
  mesh: Mesh;
  deviations: Float32Array;
  isBlank: Uint8Array; // per vertex: 255 on the blank
}

function shows(mesh: Mesh): Mesh {
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.layers.enable(CONTACT_LAYER);
  return mesh;
}

function paint(geometry: BufferGeometry, isBlank: Uint8Array): void {
  geometry.setAttribute("blank", new BufferAttribute(isBlank, 1, true));
  geometry.setAttribute("tint", new BufferAttribute(new Uint8Array(4 * isBlank.length), 4, true));
}

export class Part {
  readonly group = new Group();
  // The box of the blank, shown until the part arrives. It uses the same material, so that one shader is enough.
  readonly box: Mesh;
  private readonly stock = new Group();
  private readonly chunks = new Map<string, Chunk>();
  private readonly uncoloured = new Set<string>();
  private readonly rough = new Set<string>();
  private whenExact: (() => void)[] = [];
  private colouring: Colouring = "plain";
  private colouringOn = false;
  private shown = 0;
  private fill = 0;
  private job: JobFrame | undefined;

  constructor(
    private readonly material: Material,
    private readonly heatMap: HeatMap,
    private readonly draw: () => void,
  ) {
    const cube = new BoxGeometry();
    paint(cube, new Uint8Array(cube.getAttribute("position").count).fill(255));
    this.box = shows(new Mesh(cube, material));
    this.box.visible = false;
    this.group.add(this.box, this.stock);
  }

  begin(job: JobFrame): void {
    this.job = job;
    for (const { mesh } of this.chunks.values()) mesh.geometry.dispose();
    this.chunks.clear();
    this.stock.clear();
    this.uncoloured.clear();
    this.rough.clear();
    this.tellIfExact();
    this.fill = 0;
    this.placeBox(1);
    this.box.visible = true;
  }
  // The part is there in place of its box.
  arrived(): void {
    this.box.visible = this.fill > 0;
  }
  // The box of the blank stands over the part up to a share of its height; 0: not at all.
  setFill(share: number): void {
    this.fill = share;
    this.placeBox(share, INSET);
    this.arrived();
  }
  private placeBox(share: number, inset = 0): void {
    if (!this.job) return;
    const { min, max } = this.job.blank;
    const size = vec3((k) => (max[k] - min[k]) * (1 - 2 * inset));
    this.box.scale.set(size[0], size[1], Math.max(size[2] * share, 1e-6));
    const middle = vec3((k) => (min[k] + max[k]) / 2);
    this.box.position.set(middle[0], middle[1], min[2] + (inset + share / 2) * size[2]);
  }

  take(frame: ChunkFrame): void {
    const key = frame.chunk.join();
    this.note(key, frame.rough);
    const old = this.chunks.get(key);
    if (old) {
      old.mesh.geometry.dispose();
      this.stock.remove(old.mesh);
      this.chunks.delete(key);
    }
    if (frame.indices.length === 0 || !this.job) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(frame.positions, 3));
    geometry.setIndex(new BufferAttribute(frame.indices, 1));
    const isBlank = blankVertices(frame, this.job);
    paint(geometry, isBlank);
    const mesh = shows(new Mesh(geometry, this.material));
    this.chunks.set(key, { mesh, deviations: frame.deviations, isBlank });
    this.stock.add(mesh);
    if (this.colouring !== "plain") this.colourLater([key]);
  }

  setColouring(colouring: Colouring): void {
    this.colouring = colouring;
    this.uncoloured.clear();
    this.colourLater(this.chunks.keys());
  }

  // The data of these rows is other than it was.
  recolourAround(rows: Row[]): void {
    if (!this.job) return;
    const reach = Math.max(...this.job.cutters.map((cutter) => cutter.length));
    const box = new Box3();
    for (const row of rows) box.expandByPoint(new Vector3(...row.tip));
    box.expandByScalar(reach);
    const touched = [...this.chunks].filter(([, { mesh }]) => {
      if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
      return box.intersectsBox(mesh.geometry.boundingBox!);
    });
    this.colourLater(touched.map(([key]) => key));
  }

  /** Deviations of the vertices that are machined, mm. */
  *deviations(): Generator<number> {
    for (const { deviations, isBlank } of this.chunks.values()) {
      for (let n = 0; n < deviations.length; ++n) {
        const off = deviations[n]!;
        if (isBlank[n] === 0 && !Number.isNaN(off)) yield off;
      }
    }
  }

  private note(key: string, isRough: boolean): void {
    if (isRough) this.rough.add(key);
    else this.rough.delete(key);
    this.tellIfExact();
  }

  private tellIfExact(): void {
    if (this.rough.size > 0) return;
    for (const tell of this.whenExact.splice(0)) tell();
  }

  /** Waits while chunks are drawn roughly. */
  async exact(): Promise<void> {
    if (this.rough.size > 0) await new Promise<void>((tell) => this.whenExact.push(tell));
  }

  triangles(): Triangles[] {
    return [...this.chunks.values()].map(({ mesh: { geometry }, isBlank }) => ({
      positions: geometry.getAttribute("position").array,
      indices: geometry.getIndex()!.array,
      onBlank: isBlank,
    }));
  }

  hit(rays: Raycaster): Hit | undefined {
    const [first] = rays.intersectObjects(this.stock.children, false);
    if (!first?.face) return undefined;
    const chunk = [...this.chunks.values()].find(({ mesh }) => mesh === first.object)!;
    const corners = [first.face.a, first.face.b, first.face.c];
    return {
      point: this.group.worldToLocal(first.point.clone()).toArray(),
      normal: first.face.normal.toArray(),
      deviation: deviationAt(first, corners, chunk),
      untouched: corners.every((n) => chunk.isBlank[n] !== 0),
    };
  }

  private colourLater(keys: Iterable<string>): void {
    for (const key of keys) this.uncoloured.add(key);
    if (this.colouringOn) return;
    this.colouringOn = true;
    const go = () => {
      this.colour();
      const done = this.uncoloured.size === 0;
      if (done || performance.now() - this.shown > SHOWN_EVERY_MS) {
        this.shown = performance.now();
        this.draw();
      }
      this.colouringOn = !done;
      if (!done) setTimeout(go, 0);
    };
    setTimeout(go, 0);
  }

  private colour(): void {
    const began = performance.now();
    for (const key of this.uncoloured) {
      if (performance.now() - began > COLOURING_MS) return;
      this.uncoloured.delete(key);
      const chunk = this.chunks.get(key);
      if (!chunk) continue;
      const { geometry } = chunk.mesh;
      const positions = geometry.getAttribute("position").array as Float32Array;
      const tint = geometry.getAttribute("tint") as BufferAttribute;
      const bytes = tint.array as Uint8Array;
      bytes.fill(0);
      for (let n = 0; this.colouring !== "plain" && n < chunk.isBlank.length; ++n) {
        if (chunk.isBlank[n] !== 0) continue;
        const p = vec3((k) => positions[3 * n + k]!);
        const c = this.heatMap.colour(this.colouring, p, chunk.deviations[n] ?? Number.NaN);
        if (c) bytes.set([255 * c[0], 255 * c[1], 255 * c[2], 255], 4 * n);
      }
      tint.needsUpdate = true;
    }
  }
}

function deviationAt({ point, object }: Intersection, corners: number[], { deviations, mesh }: Chunk): number {
  if (deviations.length === 0) return Number.NaN;
  const position = mesh.geometry.getAttribute("position");
  const at = object.worldToLocal(point.clone());
  const places = corners.map((n) => new Vector3().fromBufferAttribute(position, n));
  const area = (a: Vector3, b: Vector3, c: Vector3) => b.clone().sub(a).cross(c.clone().sub(a)).length();
  const whole = area(places[0]!, places[1]!, places[2]!);
  if (whole === 0) return deviations[corners[0]!]!;
  return corners.reduce(
    (sum, n, k) => sum + (deviations[n]! * area(at, places[(k + 1) % 3]!, places[(k + 2) % 3]!)) / whole,
    0,
  );
}

function blankVertices({ positions, onBlank }: ChunkFrame, { blank, cell }: JobFrame): Uint8Array {
  const isBlank = new Uint8Array(positions.length / 3);
  if (onBlank !== undefined) return isBlank.fill(255, 0, onBlank);
  for (let n = 0; n < positions.length; ++n) {
    const axis = (n % 3) as 0 | 1 | 2;
    const away = Math.min(Math.abs(positions[n]! - blank.min[axis]), Math.abs(positions[n]! - blank.max[axis]));
    if (away < ON_BLANK * cell) isBlank[Math.floor(n / 3)] = 255;
  }
  return isBlank;
}

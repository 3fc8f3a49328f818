// SPDX-License-Identifier: MIT
// What is seen: the stock chunk by chunk, the tool, the path coloured by force, the force as an arrow.
// Colours are the paper's: cutter yellow, machined surface blue; stock that no tool has touched is grey.

import {
  ArrowHelper,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  LatheGeometry,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Quaternion,
  Scene as ThreeScene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import type { ChunkFrame, JobFrame, Row, StateFrame, Vec3 } from "./frames.js";
import { heat } from "./heat.js";
import { outline } from "./tool.js";

const MACHINED = new Color(0x4f86c6);
const UNTOUCHED = new Color(0xa9adb4);
const TOOL = new Color(0xe8b800);
const PIXEL_RATIO_CAP = 2;
// A point this near to a side of the blank is on it; of the cell.
const ON_BLANK = 1e-3;
// Rows whose time is this near follow one another, s.
const SAME_CUT_S = 1e-6;
const UP = new Vector3(0, 0, 1);

export class Scene {
  private readonly renderer: WebGLRenderer;
  private readonly three = new ThreeScene();
  private readonly camera = new PerspectiveCamera(40, 1, 0.1, 10000);
  private readonly controls: OrbitControls;
  private readonly stock = new Group();
  private readonly chunks = new Map<string, Mesh>();
  private readonly material = new MeshStandardMaterial({
    vertexColors: true,
    flatShading: true,
    metalness: 0.1,
    roughness: 0.55,
  });
  private readonly tool = new Group();
  private readonly tools: Mesh[] = [];
  private readonly force = new ArrowHelper(new Vector3(1, 0, 0), new Vector3(), 1, 0xd0342c);
  private readonly path = new Group();
  private cut: LineSegments | undefined;
  private rows: Row[] = [];
  private drawnRows = 0;
  private largest = 1;
  private job: JobFrame | undefined;
  private wanted = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, PIXEL_RATIO_CAP));
    this.camera.up.copy(UP);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    const sun = new DirectionalLight(0xffffff, 2.6);
    sun.position.set(-0.5, -1, 1.2);
    this.camera.add(sun);
    this.three.add(new HemisphereLight(0xffffff, 0x8a93a0, 1.9), this.camera);
    this.three.add(this.stock, this.tool, this.path, this.force);
    this.force.visible = false;
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  begin(job: JobFrame): void {
    const first = !this.job;
    this.job = job;
    for (const mesh of this.chunks.values()) mesh.geometry.dispose();
    this.chunks.clear();
    this.stock.clear();
    this.rows = [];
    this.drawnRows = 0;
    this.largest = 1;
    this.setTools(job);
    this.setPath(job);
    if (first) this.fit();
    this.draw();
  }

  take(chunk: ChunkFrame): void {
    const key = chunk.chunk.join();
    const old = this.chunks.get(key);
    if (old) {
      old.geometry.dispose();
      this.stock.remove(old);
      this.chunks.delete(key);
    }
    if (chunk.indices.length === 0 || !this.job) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(chunk.positions, 3));
    geometry.setAttribute("color", new BufferAttribute(this.colours(chunk.positions, this.job), 3));
    geometry.setIndex(new BufferAttribute(chunk.indices, 1));
    const mesh = new Mesh(geometry, this.material);
    this.chunks.set(key, mesh);
    this.stock.add(mesh);
    this.draw();
  }

  addRows(rows: Row[]): void {
    this.rows.push(...rows);
    const before = this.largest;
    for (const row of rows) this.largest = Math.max(this.largest, row.peakForce);
    // The scale grew: what is drawn changes its colours too.
    if (this.largest > before) this.drawnRows = 0;
    this.drawCut();
    this.draw();
  }

  show(state: StateFrame): void {
    if (!this.job) return;
    this.tool.position.set(...state.tip);
    this.tool.quaternion.copy(new Quaternion().setFromUnitVectors(UP, new Vector3(...state.axis).normalize()));
    this.tool.children.forEach((mesh, n) => (mesh.visible = n === state.cutter));
    if (this.tool.children[state.cutter]) this.tool.children[state.cutter].rotation.z = -state.angle;
    const size = Math.hypot(...state.force);
    this.force.visible = state.cutting && size > 0;
    if (this.force.visible) {
      const longest = 0.4 * this.extent();
      this.force.position.set(...state.tip);
      this.force.setDirection(new Vector3(...state.force).normalize());
      const length = Math.max((longest * size) / this.largest, 0.02 * longest);
      this.force.setLength(length, Math.min(0.3 * length, 0.06 * longest), Math.min(0.2 * length, 0.04 * longest));
    }
    this.draw();
  }

  setVisible(what: "path" | "tool", on: boolean): void {
    (what === "path" ? this.path : this.tool).visible = on;
    this.draw();
  }

  // The whole part in view, from the front right.
  fit(): void {
    if (!this.job) return;
    const { min, max } = this.job.blank;
    const centre = new Vector3(...min).add(new Vector3(...max)).multiplyScalar(0.5);
    const size = this.extent();
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).add(new Vector3(0.4, -0.95, 0.75).multiplyScalar(1.05 * size));
    this.camera.near = size / 1000;
    this.camera.far = size * 100;
    this.controls.update();
    this.draw();
  }

  // Draws with the next picture, once however often it is asked.
  draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      const { clientWidth: width, clientHeight: height } = this.canvas;
      const now = this.renderer.getSize(new Vector2());
      if (now.x !== width || now.y !== height) {
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / Math.max(height, 1);
        this.camera.updateProjectionMatrix();
      }
      this.renderer.render(this.three, this.camera);
    });
  }

  private extent(): number {
    if (!this.job) return 1;
    const { min, max } = this.job.blank;
    return Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  }

  private colours(positions: Float32Array, job: JobFrame): Float32Array {
    const near = ON_BLANK * job.cell;
    const colours = new Float32Array(positions.length);
    for (let n = 0; n < positions.length; n += 3) {
      let on = false;
      for (let axis = 0; axis < 3; ++axis) {
        const p = positions[n + axis];
        on ||= Math.abs(p - job.blank.min[axis]) < near || Math.abs(p - job.blank.max[axis]) < near;
      }
      (on ? UNTOUCHED : MACHINED).toArray(colours, n);
    }
    return colours;
  }

  private setTools(job: JobFrame): void {
    for (const mesh of this.tools) mesh.geometry.dispose();
    this.tools.length = 0;
    this.tool.clear();
    for (const cutter of job.cutters) {
      const profile = outline(cutter).map(([r, z]) => new Vector2(r, z));
      const geometry = new LatheGeometry(profile, 48).rotateX(Math.PI / 2);
      const material = new MeshStandardMaterial({ color: TOOL, metalness: 0.3, roughness: 0.4 });
      material.transparent = true;
      material.opacity = 0.85;
      const mesh = new Mesh(geometry, material);
      this.tools.push(mesh);
      this.tool.add(mesh);
    }
  }

  private setPath(job: JobFrame): void {
    this.path.clear();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(job.path.points, 3));
    this.path.add(new Line(geometry, new LineBasicMaterial({ color: 0x8a93a0, transparent: true, opacity: 0.45 })));
    this.cut = undefined;
  }

  private drawCut(): void {
    const needed = this.rows.length;
    let capacity = this.cut ? this.cut.geometry.getAttribute("position").count / 2 : 0;
    if (!this.cut || capacity < needed) {
      capacity = Math.max(1024, 2 * needed);
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(6 * capacity), 3));
      geometry.setAttribute("color", new BufferAttribute(new Float32Array(6 * capacity), 3));
      if (this.cut) {
        this.cut.geometry.dispose();
        this.path.remove(this.cut);
      }
      this.cut = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true }));
      this.cut.frustumCulled = false;
      this.path.add(this.cut);
      this.drawnRows = 0;
    }
    const position = this.cut.geometry.getAttribute("position") as BufferAttribute;
    const colour = this.cut.geometry.getAttribute("color") as BufferAttribute;
    for (let n = this.drawnRows; n < needed; ++n) {
      const row = this.rows[n];
      const before = this.rows[n - 1];
      const joined = before && row.time - before.time - before.duration < SAME_CUT_S;
      const from: Vec3 = joined ? before.tip : row.tip;
      const c = heat(row.peakForce / this.largest);
      position.setXYZ(2 * n, ...from);
      position.setXYZ(2 * n + 1, ...row.tip);
      colour.setXYZ(2 * n, ...c);
      colour.setXYZ(2 * n + 1, ...c);
    }
    this.drawnRows = needed;
    position.needsUpdate = true;
    colour.needsUpdate = true;
    this.cut.geometry.setDrawRange(0, 2 * needed);
  }
}

// SPDX-License-Identifier: MIT
// The scene: the stock in chunks, the designed surface, the tool and its latest positions, the path, and the overlays
// (overlays.ts).

import {
  Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  GreaterDepth,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene as ThreeScene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import type { ChunkFrame, DesignedFrame, JobFrame, PathFrame, Row, StateFrame } from "@tribo/protocol/frames";
import { HeatMap, type Colouring } from "./heat_map.js";
import { Overlays } from "./overlays.js";
import { PALETTES, type Palette } from "./palette.js";
import { PathLines } from "./path_lines.js";
import { Tool } from "./tool.js";
import { vec3, type Axis, type Vec3 } from "@tribo/protocol/vec3";

const PIXEL_RATIO_CAP = 2;
// A point closer to a side of the blank counts as on it; in cells.
const ON_BLANK = 1e-3;
// A large part is coloured in pieces, ms each, and drawn at intervals, ms.
const COLOURING_MS = 8;
const SHOWN_EVERY_MS = 200;

export interface Hit {
  point: Vec3;
  normal: Vec3;
}

export class Scene {
  readonly renderer: WebGLRenderer;
  readonly three = new ThreeScene();
  readonly camera = new PerspectiveCamera(40, 1, 0.1, 10000);
  readonly controls: OrbitControls;
  // All objects of the job, in its millimetres. VR places them on a bench.
  readonly world = new Group();
  readonly overlays: Overlays;
  readonly heatMap = new HeatMap();
  job: JobFrame | undefined;
  private palette: Palette = PALETTES.paper;
  private readonly stock = new Group();
  private readonly designed = new Group();
  private readonly chunks = new Map<string, Mesh>();
  // Of the vertices, by chunk.
  private readonly deviations = new Map<string, Float32Array>();
  private readonly material = new MeshStandardMaterial({
    vertexColors: true,
    flatShading: true,
    metalness: 0.15,
    roughness: 0.5,
  });
  private readonly pink = new MeshStandardMaterial({
    color: PALETTES.paper.designed,
    transparent: true,
    opacity: 0.4,
    side: DoubleSide,
    roughness: 0.7,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: 4,
    polygonOffsetUnits: 64,
  });
  // The part of the designed surface that is still inside the stock.
  private readonly hiddenPink = new MeshBasicMaterial({
    color: PALETTES.paper.designed,
    transparent: true,
    opacity: 0.16,
    side: DoubleSide,
    depthWrite: false,
    depthFunc: GreaterDepth,
  });
  // The box of the blank, shown until the part arrives. It uses the same material, so that one shader is enough.
  private readonly box = new Mesh(new BoxGeometry(), this.material);
  private readonly tool: Tool;
  private readonly path = new PathLines();
  private readonly rays = new Raycaster();
  private axis: Vec3 = [0, 0, 1];
  private cutter = 0;
  private colouring: Colouring = "plain";
  private readonly uncoloured = new Set<string>();
  private colouringOn = false;
  private shown = 0;
  private wanted = false;
  private seen = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    context?: WebGL2RenderingContext,
  ) {
    this.renderer = new WebGLRenderer({ canvas, context, antialias: true, alpha: true });
    // Checking for errors would wait for every shader, one after the other.
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, PIXEL_RATIO_CAP));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    const sun = new DirectionalLight(0xffffff, 2.7);
    sun.position.set(-0.6, 0.9, 1);
    this.camera.add(sun);
    this.tool = new Tool(this.palette.cutter);
    this.overlays = new Overlays(this.palette);
    const corners = this.box.geometry.getAttribute("position").count;
    const grey = new Color(this.palette.untouched).toArray() as Vec3;
    this.box.geometry.setAttribute(
      "color",
      new BufferAttribute(
        Float32Array.from({ length: 3 * corners }, (_, n) => grey[(n % 3) as Axis]),
        3,
      ),
    );
    this.box.visible = false;
    this.world.add(this.box, this.stock, this.designed, this.tool.group, this.path.group, this.overlays.group);
    this.three.add(new HemisphereLight(0xffffff, 0x8f98a6, 2.3), this.camera, this.world);
    // Prepares graphics memory and shader while the job is loading.
    this.resize();
    this.renderer.compile(this.box, this.camera, this.three);
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  get hasDesigned(): boolean {
    return this.designed.children.length > 0;
  }

  begin(job: JobFrame): void {
    this.job = job;
    for (const mesh of this.chunks.values()) mesh.geometry.dispose();
    this.chunks.clear();
    this.stock.clear();
    this.designed.clear();
    this.uncoloured.clear();
    this.deviations.clear();
    const { min, max } = job.blank;
    this.box.position.set((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2);
    this.box.scale.set(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
    this.box.visible = true;
    this.heatMap.begin(job.cutters);
    this.tool.begin(job.cutters);
    this.path.begin();
    this.overlays.begin(this.extent());
    this.draw();
  }

  take(chunk: ChunkFrame): void {
    const key = chunk.chunk.join();
    const old = this.chunks.get(key);
    if (old) {
      old.geometry.dispose();
      this.stock.remove(old);
      this.chunks.delete(key);
      this.deviations.delete(key);
    }
    if (chunk.indices.length === 0 || !this.job) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(chunk.positions, 3));
    geometry.setAttribute("color", new BufferAttribute(this.plain(chunk.positions, this.job), 3));
    geometry.setIndex(new BufferAttribute(chunk.indices, 1));
    const mesh = new Mesh(geometry, this.material);
    this.chunks.set(key, mesh);
    this.deviations.set(key, chunk.deviations);
    this.stock.add(mesh);
    if (this.colouring !== "plain") this.colourLater([key]);
    this.draw();
  }

  addPath(frame: PathFrame): void {
    this.path.take(frame);
    this.draw();
  }

  addDesigned(frame: DesignedFrame): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(frame.positions, 3));
    geometry.setIndex(new BufferAttribute(frame.indices, 1));
    geometry.computeVertexNormals();
    const hidden = new Mesh(geometry, this.hiddenPink);
    hidden.renderOrder = 1;
    this.designed.add(new Mesh(geometry, this.pink), hidden);
    this.draw();
  }

  addRows(rows: Row[]): void {
    const cutter = this.job?.cutters[this.cutter];
    if (!cutter) return;
    for (const row of rows) this.heatMap.add(row, this.axis, cutter);
    this.path.add(rows, (row) => this.heatMap.ofRow(this.colouring, row), this.heatMap.largestForce);
    this.draw();
  }

  // Multipliers of rows, from number `first` on, are known now, or others.
  showMultipliers(rows: Row[], first: number): void {
    if (this.colouring !== "chatter" || !this.job) return;
    this.path.recolourFrom(first);
    const reach = Math.max(...this.job.cutters.map((cutter) => cutter.length));
    const box = new Box3();
    for (const row of rows) box.expandByPoint(new Vector3(...row.tip));
    box.expandByScalar(reach);
    const touched = [...this.chunks].filter(([, { geometry }]) => {
      if (!geometry.boundingBox) geometry.computeBoundingBox();
      return box.intersectsBox(geometry.boundingBox!);
    });
    this.colourLater(touched.map(([key]) => key));
    this.draw();
  }

  // Feed, speed or material have changed: all rows are sent again.
  forgetRows(): void {
    if (!this.job) return;
    this.heatMap.begin(this.job.cutters);
    this.path.forgetRows();
    this.setColouring(this.colouring);
  }

  show(state: StateFrame): void {
    if (!this.job) return;
    // The state frame follows the frames of the part.
    this.box.visible = false;
    this.axis = state.axis;
    this.cutter = state.cutter;
    this.tool.show(state);
    this.overlays.showForce(state);
    this.draw();
  }

  setVisible(what: "path" | "tool" | "designed" | "positions", on: boolean): void {
    if (what === "path") this.path.group.visible = on;
    else if (what === "tool") this.tool.group.visible = on;
    else if (what === "positions") this.tool.positionsVisible = on;
    else this.designed.visible = on;
    this.draw();
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    this.pink.color.set(palette.designed);
    this.hiddenPink.color.set(palette.designed);
    this.tool.setColour(palette.cutter);
    this.overlays.setPalette(palette);
    this.setColouring(this.colouring);
  }

  setColouring(colouring: Colouring): void {
    this.colouring = colouring;
    if (this.job) this.path.recolour((row) => this.heatMap.ofRow(colouring, row));
    this.uncoloured.clear();
    this.colourLater(this.chunks.keys());
  }

  // Returns the point of the part at a position of the canvas (CSS pixels from its corner).
  pick(x: number, y: number): Hit | undefined {
    const at = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    this.rays.setFromCamera(at, this.camera);
    return this.hit();
  }
  hit(rays = this.rays): Hit | undefined {
    const [first] = rays.intersectObjects(this.stock.children, false);
    if (!first?.face) return undefined;
    return { point: this.world.worldToLocal(first.point.clone()).toArray(), normal: first.face.normal.toArray() };
  }

  // Returns the highest point of the part below a point, or undefined.
  surfaceBelow(x: number, y: number): number | undefined {
    if (!this.job) return undefined;
    const from = this.world.localToWorld(new Vector3(x, y, this.job.blank.max[2] + this.extent()));
    const to = this.world.localToWorld(new Vector3(x, y, this.job.blank.min[2] - this.extent()));
    this.rays.set(from, to.sub(from).normalize());
    return this.hit()?.point[2];
  }

  // Shows the whole part from the front right.
  fit(): void {
    if (!this.job) return;
    const { min, max } = this.job.blank;
    const centre = new Vector3(...min).add(new Vector3(...max)).multiplyScalar(0.5);
    const size = this.extent();
    // A tall window shows less at the sides.
    const narrow = Math.max(1, 1.05 / Math.max(this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1), 0.2));
    // The tool is above the part.
    centre.z += 0.12 * size;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).add(new Vector3(0.4, -0.95, 0.8).multiplyScalar(1.22 * size * narrow));
    this.camera.near = size / 1000;
    this.camera.far = size * 100;
    this.controls.update();
    this.draw();
  }

  // Turns the view about the part, rad, and moves it closer by a factor.
  orbit(right: number, up: number, nearer = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, -right);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const tilted = offset.clone().applyAxisAngle(side, -up);
    if (tilted.angleTo(this.camera.up) > 0.05 && tilted.angleTo(this.camera.up) < Math.PI - 0.05) offset.copy(tilted);
    this.camera.position.copy(this.controls.target).add(offset.multiplyScalar(nearer));
    this.controls.update();
  }

  // Draws with the next picture, once for any number of calls.
  draw(): void {
    if (this.wanted || !this.job || this.renderer.xr.isPresenting) return;
    this.wanted = true;
    const go = () => {
      this.wanted = false;
      this.render();
    };
    // The first picture must already wait for its shaders.
    if (this.seen) requestAnimationFrame(go);
    else queueMicrotask(go);
  }

  // Draws immediately. VR calls it for each of its pictures.
  render(): void {
    if (!this.renderer.xr.isPresenting) this.resize();
    // Draw the part first. The shaders of the other objects are made for the next picture.
    const around = this.seen
      ? []
      : this.world.children.filter((child) => child.visible && child !== this.box && child !== this.stock);
    for (const child of around) child.visible = false;
    this.renderer.render(this.three, this.camera);
    for (const child of around) child.visible = true;
    if (this.seen) return;
    this.seen = true;
    this.draw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const now = this.renderer.getSize(new Vector2());
    if (now.x === width && now.y === height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  extent(): number {
    if (!this.job) return 1;
    const { min, max } = this.job.blank;
    return Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  }

  private onBlank(positions: Float32Array, n: number, job: JobFrame): boolean {
    const near = ON_BLANK * job.cell;
    for (const axis of [0, 1, 2] as const) {
      const p = positions[n + axis]!;
      if (Math.abs(p - job.blank.min[axis]) < near || Math.abs(p - job.blank.max[axis]) < near) return true;
    }
    return false;
  }

  private plain(positions: Float32Array, job: JobFrame): Float32Array {
    const machined = new Color(this.palette.machined);
    const untouched = new Color(this.palette.untouched);
    const colours = new Float32Array(positions.length);
    for (let n = 0; n < positions.length; n += 3)
      (this.onBlank(positions, n, job) ? untouched : machined).toArray(colours, n);
    return colours;
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
    if (!this.job) return this.uncoloured.clear();
    const began = performance.now();
    for (const key of this.uncoloured) {
      if (performance.now() - began > COLOURING_MS) return;
      this.uncoloured.delete(key);
      const mesh = this.chunks.get(key);
      if (!mesh) continue;
      const positions = mesh.geometry.getAttribute("position").array as Float32Array;
      const deviations = this.deviations.get(key);
      const colours = this.plain(positions, this.job);
      for (let n = 0; this.colouring !== "plain" && n < positions.length; n += 3) {
        if (this.onBlank(positions, n, this.job)) continue;
        const p = vec3((k) => positions[n + k]!);
        const c = this.heatMap.colour(this.colouring, p, deviations?.[n / 3] ?? Number.NaN);
        if (c) new Color().setRGB(...c, "srgb").toArray(colours, n);
      }
      mesh.geometry.setAttribute("color", new BufferAttribute(colours, 3));
    }
  }
}

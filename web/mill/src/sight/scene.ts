// SPDX-License-Identifier: MIT
// The scene: the part, the designed surface, the tool, the path, and the overlays (overlays.ts), with their light and the
// camera.

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  GreaterDepth,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  NeutralToneMapping,
  NoToneMapping,
  PerspectiveCamera,
  type Ray,
  Raycaster,
  Scene as ThreeScene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import type { ChunkFrame, DesignedFrame, JobFrame, PathFrame, Row, StateFrame } from "@tribo/protocol/frames";
import { vec3 } from "@tribo/protocol/vec3";
import { afterPicture } from "@tribo/ui/frame";
import { USUAL_VIEW } from "@tribo/ui/studio";
import type { View } from "../keep/moment.js";
import { t } from "../texts/texts.js";
import type { Triangles } from "../keep/triangles.js";
import { Contact } from "./contact.js";
import { centre, cornersOf, eyeFor, type Free } from "./framing.js";
import { HeatMap, type Colouring } from "./heat_map.js";
import { Light } from "./light.js";
import { PartMaterial } from "./metal.js";
import { Overlays } from "./overlays.js";
import { Pace } from "./pace.js";
import { PALETTES, type Palette } from "./palette.js";
import { Part, type Hit } from "./part.js";
import { Pass, type PassShown } from "./pass.js";
import { Tool } from "./tool.js";

const PIXEL_RATIO_CAP = 2;
const VIEW = new Vector3(...USUAL_VIEW).normalize();
// Share of the free window that the part fills, and with nothing beside it.
const FILLED = 0.86;
const FILLED_ALONE = 0.96;
// Turns of a part that together cover what it fills while it turns.
const TURNS = 16;
// A state has the time of a stand, but for rounding.
const SAME_TIME_S = 1e-3;
// Room for the tool: above the part by this share of its size, and where it stands no farther from the part.
const TOOL_ROOM = 0.25;
// All of a tool is kept in sight up to this distance, in distances at which its cutter is seen.
const MOST_AWAY = 1.4;

/** The camera looks at `target` from the direction `towards` (unit) at a distance, mm. */
export interface Pose {
  target: Vector3;
  towards: Vector3;
  distance: number;
}

/** "auto": fine, until it is too slow. */
export type Look = "auto" | "fine" | "plain";

export class Scene {
  readonly renderer: WebGLRenderer;
  readonly three = new ThreeScene();
  readonly camera = new PerspectiveCamera(34, 1, 0.1, 10000);
  readonly controls: OrbitControls;
  // All objects of the job, in its millimetres. VR places them on a bench.
  readonly world = new Group();
  // Tool, pass and overlays: what is not the part.
  private readonly around = new Group();
  readonly overlays: Overlays;
  readonly heatMap = new HeatMap();
  readonly part: Part;
  job: JobFrame | undefined;
  /** Called after each picture, in its task. */
  drawn: (() => void) | undefined;
  private palette: Palette = PALETTES.metal;
  private readonly contact = new Contact();
  private readonly material = new PartMaterial(this.palette, this.contact.uniforms);
  private readonly light: Light;
  private readonly designed = new Group();
  // A film pushed away from the eye, so that it never flickers against a cut that lies on it.
  private readonly pink = new MeshStandardMaterial({
    color: this.palette.designed,
    transparent: true,
    opacity: 0.4,
    side: DoubleSide,
    roughness: 0.7,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: 16,
    polygonOffsetUnits: 4096,
  });
  // The part of the designed surface that is still inside the stock.
  private readonly hiddenPink = new MeshBasicMaterial({
    color: this.palette.designed,
    transparent: true,
    opacity: 0.16,
    side: DoubleSide,
    depthWrite: false,
    depthFunc: GreaterDepth,
    polygonOffset: true,
    polygonOffsetFactor: 16,
    polygonOffsetUnits: 4096,
  });
  private readonly tool: Tool;
  private readonly pass: Pass;
  private readonly rays = new Raycaster();
  private readonly pace = new Pace(() => {
    this.slow = true;
    this.choose();
  });
  private look: Look = "auto";
  private slow = false;
  private headset = false;
  private colouring: Colouring = "plain";
  private wanted = false;
  private seen = false;
  private free: (() => Free) | undefined;
  // The camera stands where fit() put it.
  private fitted = false;
  // Where the tool stands before the first move and after the last. `tool`: all of it, once it has been seen there.
  private stands: { time: number; tip: Vector3; tool?: Box3 }[] = [];

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
    this.controls.addEventListener("change", () => {
      this.fitted = false;
      this.draw();
    });
    this.light = new Light(this.renderer, this.three, this.camera);
    this.tool = new Tool(this.palette.cutter);
    this.overlays = new Overlays(this.palette);
    this.pass = new Pass();
    this.part = new Part(this.material, this.heatMap, () => this.draw());
    this.designed.visible = false;
    this.around.add(this.tool.group, this.pass.group, this.overlays.group);
    this.world.add(this.light.group, this.part.group, this.designed, this.around);
    this.three.add(this.camera, this.world);
    // Prepares graphics memory and shader while the job is loading.
    this.resize();
    this.renderer.compile(this.part.box, this.camera, this.three);
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  get hasDesigned(): boolean {
    return this.designed.children.length > 0;
  }
  get colours(): Palette {
    return this.palette;
  }
  get fine(): boolean {
    return this.light.fine;
  }

  begin(job: JobFrame): void {
    this.job = job;
    this.stands = [];
    this.designed.clear();
    this.part.begin(job);
    this.heatMap.begin(job.cutters);
    this.tool.begin(job.cutters);
    this.pass.begin(this.extent());
    this.overlays.begin(this.extent());
    this.light.begin(this.blank(), Math.max(...job.cutters.map((c) => 2 * c.length), 0));
    this.draw();
  }

  take(chunk: ChunkFrame): void {
    this.part.take(chunk);
    this.moved();
  }

  addPath(frame: PathFrame): void {
    this.pass.takePath(frame);
    const { points, times } = frame;
    const ends = times.length > 0 ? [0, times.length - 1] : [];
    this.stands = ends.map((n) => ({ time: times[n]!, tip: new Vector3().fromArray(points, 3 * n) }));
    if (this.fitted) this.fit();
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
    for (const row of rows) this.heatMap.add(row);
    this.pass.add(rows, this.heatMap, this.colouring);
    this.draw();
  }

  // Multipliers of rows, from number `first` on, are known now, or others.
  showMultipliers(rows: Row[], first: number): void {
    if (this.colouring !== "chatter" || !this.job) return;
    this.pass.recolourFrom(first);
    this.part.recolourAround(rows);
    this.draw();
  }

  // Feed, speed or material have changed: all rows are sent again.
  forgetRows(): void {
    if (!this.job) return;
    this.heatMap.begin(this.job.cutters);
    this.pass.forgetRows();
    this.setColouring(this.colouring);
  }

  show(state: StateFrame): void {
    if (!this.job) return;
    // The state frame follows the frames of the part.
    this.part.arrived();
    this.tool.show(state);
    const stand = this.stands.find(({ time }) => Math.abs(time - state.time) < SAME_TIME_S);
    if (stand && !stand.tool) {
      stand.tool = this.tool.box();
      if (this.fitted) this.fit();
    }
    this.pass.show(state.time, this.heatMap, this.colouring);
    this.overlays.showForce(state);
    this.moved();
  }

  setHelix(degrees: number): void {
    this.tool.setHelix(degrees);
    this.moved();
  }

  setVisible(what: "tool" | "designed" | "positions" | "arrow", on: boolean): void {
    if (what === "tool") this.tool.group.visible = on;
    else if (what === "positions") this.tool.positionsVisible = on;
    else if (what === "arrow") this.overlays.arrowVisible = on;
    else this.designed.visible = on;
    this.moved();
  }
  setPass(shown: PassShown): void {
    this.pass.shown = shown;
    this.draw();
  }

  // Height of the curtain, 0 to 1.
  setCurtain(share: number): void {
    this.pass.stand(share, this.heatMap, this.colouring);
    this.draw();
  }
  // Only the part is shown.
  setBare(on: boolean): void {
    this.around.visible = !on;
    this.moved();
  }
  // Fills the box of the blank from below, 0 to 1.
  setFill(share: number): void {
    this.part.setFill(share);
    this.moved();
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    this.pink.color.set(palette.designed);
    this.hiddenPink.color.set(palette.designed);
    this.material.setPalette(palette);
    this.tool.setColour(palette.cutter);
    this.overlays.setPalette(palette);
    this.draw();
  }

  setColouring(colouring: Colouring): void {
    this.colouring = colouring;
    if (this.job) this.pass.recolour(this.heatMap, colouring);
    this.part.setColouring(colouring);
  }

  setLook(look: Look): void {
    this.look = look;
    this.slow = false;
    this.pace.begin();
    if (this.seen) this.choose();
  }

  // A headset draws every picture twice, and without the depths of the contact shading.
  private choose(): void {
    this.setFine(this.look !== "plain" && !this.slow && !this.headset);
  }

  private setFine(fine: boolean): void {
    this.renderer.toneMapping = fine ? NeutralToneMapping : NoToneMapping;
    this.light.setFine(fine);
    this.contact.setFine(fine);
    this.material.setFine(fine);
    this.tool.setFine(fine);
    this.draw();
  }

  // Returns the point of the part at a position of the canvas (CSS pixels from its corner).
  pick(x: number, y: number): Hit | undefined {
    this.aimRay(x, y);
    return this.part.hit(this.rays);
  }
  // The ray from the eye through a position of the canvas.
  rayAt(x: number, y: number): Ray {
    this.aimRay(x, y);
    return this.rays.ray;
  }
  private aimRay(x: number, y: number): void {
    const at = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    this.rays.setFromCamera(at, this.camera);
  }

  // Returns the highest point of the part below a point, or undefined.
  surfaceBelow(x: number, y: number): number | undefined {
    if (!this.job) return undefined;
    const from = this.world.localToWorld(new Vector3(x, y, this.job.blank.max[2] + this.extent()));
    const to = this.world.localToWorld(new Vector3(x, y, this.job.blank.min[2] - this.extent()));
    this.rays.set(from, to.sub(from).normalize());
    return this.part.hit(this.rays)?.point[2];
  }

  // The part of the window that fit() may use.
  keepFree(free: () => Free): void {
    this.free = free;
  }

  // Shows the whole part from the front right.
  fit(): void {
    if (!this.job) return;
    this.resize();
    this.pose = this.wholePose();
    this.fitted = true;
  }
  /** The whole part with room for the tool, and where it stands at first and at last if that is near. */
  wholePose(): Pose {
    const box = this.blank();
    box.max.z += TOOL_ROOM * this.extent();
    const points = cornersOf(box);
    const radius = Math.max(...this.job!.cutters.map((cutter) => cutter.radius), 0);
    const tools: Vector3[] = [];
    for (const { tip, tool } of this.stands) {
      if (box.distanceToPoint(tip) >= TOOL_ROOM * this.extent()) continue;
      const cutter = new Box3().setFromCenterAndSize(
        tip.clone().setZ(tip.z + radius),
        new Vector3().setScalar(2 * radius),
      );
      points.push(...cornersOf(cutter));
      // A high window has room for the holder.
      if (tool && this.camera.aspect < 1) tools.push(...cornersOf(tool));
    }
    const withCutter = this.poseOf(points, VIEW, FILLED);
    const withHolder = this.poseOf([...points, ...tools], VIEW, FILLED);
    return withHolder.distance < MOST_AWAY * withCutter.distance ? withHolder : withCutter;
  }
  /** The part alone from any side: nothing of it leaves the picture while it turns. */
  partPose(towards: Vector3): Pose {
    const box = this.blank();
    const middle = box.getCenter(new Vector3());
    const up = new Vector3(0, 0, 1);
    const points = cornersOf(box).flatMap((corner) =>
      Array.from({ length: TURNS }, (_, n) =>
        corner
          .clone()
          .sub(middle)
          .applyAxisAngle(up, (2 * Math.PI * n) / TURNS)
          .add(middle),
      ),
    );
    return this.poseOf(points, towards, FILLED_ALONE);
  }
  private poseOf(points: Vector3[], towards: Vector3, filled: number): Pose {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const free = this.free?.() ?? { x: 0, y: 0, width, height };
    centre(this.camera, width, height, free);
    const share = { width: (filled * free.width) / width, height: (filled * free.height) / height };
    const middle = this.blank().getCenter(new Vector3());
    return { towards: towards.clone(), ...eyeFor(points, middle, towards, this.camera, share) };
  }
  get pose(): Pose {
    const target = this.controls.target.clone();
    const away = this.camera.position.clone().sub(target);
    return { target, towards: away.clone().normalize(), distance: away.length() };
  }
  set pose({ target, towards, distance }: Pose) {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.fitted = false;
    this.aim();
  }
  private aim(): void {
    const size = this.extent();
    this.camera.near = size / 50;
    this.camera.far = size * 60;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** In full 0.001 mm: the controls change the last digits. */
  get view(): View {
    const rounded = (place: Vector3) => vec3((k) => Number(place.getComponent(k).toFixed(3)));
    return { position: rounded(this.camera.position), target: rounded(this.controls.target) };
  }
  set view({ position, target }: View) {
    this.resize();
    this.camera.position.set(...position);
    this.controls.target.set(...target);
    this.fitted = false;
    this.aim();
    this.centre();
  }

  // Turns the view about the part, rad, and moves it closer by a factor.
  orbit(right: number, up: number, nearer = 1): void {
    this.fitted = false;
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, -right);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const tilted = offset.clone().applyAxisAngle(side, -up);
    if (tilted.angleTo(this.camera.up) > 0.05 && tilted.angleTo(this.camera.up) < Math.PI - 0.05) offset.copy(tilted);
    this.camera.position.copy(this.controls.target).add(offset.multiplyScalar(nearer));
    this.controls.update();
  }

  // Something moved that throws a shadow.
  private moved(): void {
    this.light.changed();
    this.draw();
  }

  // Draws with the next picture, once for any number of calls.
  draw(): void {
    if (this.wanted || !this.job || this.renderer.xr.isPresenting) return;
    this.wanted = true;
    this.pace.asked(performance.now());
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
    const { isPresenting } = this.renderer.xr;
    if (isPresenting !== this.headset) {
      this.headset = isPresenting;
      this.choose();
    }
    if (isPresenting) {
      this.renderer.render(this.three, this.camera);
      return;
    }
    this.resize();
    this.light.follow(this.camera.position.clone().sub(this.controls.target), VIEW);
    // Draw the part first. The shaders of the other objects are made for the next picture.
    const around = this.seen
      ? []
      : this.world.children.filter(
          (child) => child.visible && ![this.part.group, this.light.group].includes(child as Group),
        );
    for (const child of around) child.visible = false;
    this.contact.render(this.renderer, this.three, this.camera);
    this.renderer.render(this.three, this.camera);
    for (const child of around) child.visible = true;
    this.drawn?.();
    if (this.look === "auto" && this.fine) this.pace.drawn(performance.now());
    if (this.seen) return;
    this.seen = true;
    // Nothing else is drawn until the first picture is on the screen. Reflections and shadows come after all objects.
    this.wanted = true;
    afterPicture(() => {
      this.wanted = false;
      this.draw();
      afterPicture(() => this.choose());
    });
  }

  /** What is seen, over the colour of the page. */
  picture(): Promise<Blob> {
    this.render();
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    this.paint(copy.getContext("2d")!);
    return new Promise((resolve, reject) =>
      copy.toBlob((blob) => (blob ? resolve(blob) : reject(new Error(t("the picture is too large")))), "image/png"),
    );
  }
  /** Copies what was drawn in this task, as afterwards the browser may have emptied the canvas. */
  paint(c: CanvasRenderingContext2D): void {
    const { width, height } = c.canvas;
    c.fillStyle = getComputedStyle(document.body).backgroundColor;
    c.fillRect(0, 0, width, height);
    // The window may have another shape by now.
    const scale = Math.min(width / this.canvas.width, height / this.canvas.height);
    const [wide, high] = [scale * this.canvas.width, scale * this.canvas.height];
    c.drawImage(this.canvas, (width - wide) / 2, (height - high) / 2, wide, high);
  }
  /** The surface of the part at this moment, mm: after a jump of the clock as soon as it is exact. */
  async triangles(): Promise<Triangles[]> {
    await this.part.exact();
    return this.part.triangles();
  }

  // The free part of the window has changed.
  centre(): void {
    if (!this.free) return;
    if (this.fitted) return this.fit();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    centre(this.camera, width, height, this.free());
    this.draw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const now = this.renderer.getSize(new Vector2());
    if (now.x === width && now.y === height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    if (this.free) centre(this.camera, width, height, this.free());
    this.camera.updateProjectionMatrix();
  }

  extent(): number {
    return this.job ? this.blank().getSize(new Vector3()).length() : 1;
  }
  private blank(): Box3 {
    return new Box3(new Vector3(...this.job!.blank.min), new Vector3(...this.job!.blank.max));
  }
}

// SPDX-License-Identifier: MIT
// <tribo-touch>: an image that yields under fingers and sounds when rubbed. docs/touch.md has the list of
// attributes, properties, events, slots, parts and CSS properties; custom-elements.json has it for tools.
import { clamp } from "@tribo/ui/clamp";
import { wordsOf } from "@tribo/ui/dom";
import { AttributeElement } from "./attributes.js";
import { Voice, warmSound } from "./audio.js";
import { engine, type Sheet } from "./engine.js";
import { Finger, kFullForceN, measuredPressure, type FingerReport } from "./fingers.js";
import { animate, stop, whenIdle } from "./frames.js";
import { keyFinger, type KeyFinger } from "./keyboard.js";
import { smallRelief, stiffnessLevels, stiffnessPalette } from "./maps.js";
import { parseMaterial, type Material } from "./material.js";
import { Relief } from "./relief.js";
import { renderer, type Picture, type Renderer } from "./renderer.js";
import { build, type Parts } from "./shadow.js";
import { Vibration } from "./vibration.js";

/** Detail of contact-start, contact-move and contact-end. */
export interface ContactDetail {
  /** Position in the image, 0 to 1 from its top left corner. */
  u: number;
  v: number;
  depth_mm: number;
  force_n: number;
  area_mm2: number;
  speed_mm_per_s: number;
  pointerType: string;
  timeStamp: number;
}

/**
 * Detail of error. After an error of `material` or `image` nothing can be shown; other errors leave the plain image,
 * or silence.
 */
export interface TriboErrorDetail {
  type: "material" | "image" | "wasm" | "webgl" | "audio";
  message: string;
}

/** idle: not requested yet; plain: only the image, which does not yield; failed: not even the image. */
export type State = "idle" | "loading" | "ready" | "plain" | "failed";

const kNodes = 512;
// As printed, equations 1 and 2 act on the whole image at every frame.
const kPublishedNodes = 256;
const kMostPixelRatio = 2;
// Number of the finger of the keyboard, beside those of pointers.
const kKeyFinger = -1;
const kNearPixels = 200;

export class TriboTouch extends AttributeElement {
  static readonly observedAttributes = [
    "src",
    "alt",
    "poster",
    "disabled",
    "muted",
    "sound",
    "stiffness",
    "damping",
    "stiffness-map",
    "as-published",
    "touch-action",
  ];

  #parts: Parts | undefined;
  #state: State = "idle";
  #material: Material | undefined;
  #sheet: Sheet | undefined;
  #picture: Picture | undefined;
  #context: CanvasRenderingContext2D | null = null;
  #renderer: Renderer | undefined;
  #voice: Voice | undefined;
  #relief: Relief | undefined;
  #vibration = new Vibration();
  #fingers = new Map<number, Finger>();
  #types = new Map<number, string>();
  #keys: KeyFinger | undefined;
  #visible = false;
  #posterDismissed = false;
  #attempt = 0;
  #inView: IntersectionObserver | undefined;
  #sized: ResizeObserver | undefined;
  #restore = () => this.#contextRestored();
  #lose = () => this.#contextLost();
  #hide = () => document.visibilityState === "hidden" && this.#liftAll();

  get state(): State {
    return this.#state;
  }
  get loaded(): boolean {
    return this.#state === "ready" || this.#state === "plain";
  }
  get material(): Material | undefined {
    return this.#material;
  }
  /** Latency from the worklet to the ear in seconds, as stated by the system. */
  get audioLatency(): number {
    return this.#voice?.latency ?? 0;
  }

  // Life --------------------------------------------------------------------------------------------------------

  connectedCallback(): void {
    this.#parts ??= this.#build();
    this.#inView = new IntersectionObserver((entries) => this.#seen(entries.at(-1)!.isIntersecting), {
      rootMargin: `${kNearPixels}px`,
    });
    this.#inView.observe(this);
    this.#sized = new ResizeObserver(() => this.#resize());
    this.#sized.observe(this.#parts.surface);
    document.addEventListener("visibilitychange", this.#hide);
    this.#describe();
    if (this.loading === "eager" || this.#near()) void this.#load();
  }

  /** True if the element is in or near the view, without waiting for an observer. */
  #near(): boolean {
    const box = this.getBoundingClientRect();
    return (
      box.width > 0 &&
      box.top < innerHeight + kNearPixels &&
      box.bottom > -kNearPixels &&
      box.left < innerWidth + kNearPixels &&
      box.right > -kNearPixels
    );
  }

  disconnectedCallback(): void {
    this.#inView?.disconnect();
    this.#sized?.disconnect();
    document.removeEventListener("visibilitychange", this.#hide);
    this.#free();
    this.#state = "idle";
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now || this.#parts === undefined) return;
    this.#describe();
    if (name === "src" || name === "as-published" || name === "stiffness-map") {
      const wanted = this.#state !== "idle" || this.#visible || this.loading === "eager";
      this.#free();
      this.#state = "idle";
      if (wanted && this.isConnected) void this.#load();
    } else if (name === "stiffness" || name === "damping") {
      this.#applyMaterial();
      animate(this);
    } else if (name === "disabled") {
      if (this.disabled) this.#liftAll();
    } else if (name === "muted" || name === "sound") {
      this.#makeVoice();
    }
  }

  #build(): Parts {
    const parts = build(this);
    const { surface } = parts;
    this.#context = parts.canvas.getContext("2d");
    surface.addEventListener("pointerdown", (event) => this.#down(event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => {
      this.#lift(event.pointerId, event.timeStamp);
      // Browsers count a touch as a gesture only when it ends.
      this.#voice?.wake();
    });
    surface.addEventListener("pointercancel", (event) => this.#lift(event.pointerId, event.timeStamp));
    surface.addEventListener("lostpointercapture", (event) => this.#lift(event.pointerId, event.timeStamp));
    surface.addEventListener("contextmenu", (event) => this.#fingers.size > 0 && event.preventDefault());
    const keys = keyFinger(
      parts,
      (u, v, firmness) => this.#touch(kKeyFinger, "keyboard", this.#keyReport(u, v), firmness),
      (finger, u, v) => finger.move(this.#keyReport(u, v)),
      () => this.#lift(kKeyFinger, performance.now()),
    );
    this.#keys = keys;
    const show = (shown: boolean) => keys.show(shown && this.#state === "ready");
    surface.addEventListener("keydown", (event) => {
      if (this.#picture === undefined || this.disabled || event.ctrlKey || event.altKey || event.metaKey) return;
      if (!keys.key(event)) return;
      event.preventDefault();
      show(true);
    });
    surface.addEventListener("focus", () => show(surface.matches(":focus-visible")));
    surface.addEventListener("blur", () => {
      keys.lift();
      show(false);
    });
    return parts;
  }

  #describe(): void {
    const { surface, image, poster, cover } = this.#parts!;
    surface.setAttribute("aria-label", this.alt || this.#material?.name || "touchable image");
    surface.setAttribute("aria-disabled", String(this.disabled));
    surface.tabIndex = this.disabled ? -1 : 0;
    surface.style.touchAction = this.getAttribute("touch-action") ?? "";
    image.alt = this.#state === "failed" ? this.alt : "";
    if (this.poster !== "" && poster.getAttribute("src") !== this.poster) poster.src = this.poster;
    poster.hidden = this.poster === "";
    cover.hidden = this.#posterDismissed;
  }

  #seen(visible: boolean): void {
    this.#visible = visible;
    if (visible && this.#state === "idle") void this.#load();
    if (visible) animate(this);
    else this.#liftAll();
  }

  #fail(type: TriboErrorDetail["type"], error: unknown): void {
    this.dispatchEvent(new CustomEvent<TriboErrorDetail>("error", { detail: { type, message: wordsOf(error) } }));
  }

  async #load(): Promise<void> {
    if (this.src === "") return;
    const attempt = ++this.#attempt;
    const stale = () => attempt !== this.#attempt || !this.isConnected;
    this.#state = "loading";
    const image = this.#parts!.image;
    // The engine is loaded together with the material and its image; shader and sound are prepared while the image is
    // loading.
    const engineReady = engine();
    engineReady.catch(() => undefined);
    try {
      const address = new URL(this.src, document.baseURI);
      const response = await fetch(address);
      if (!response.ok) throw new Error(`${address.href}: HTTP ${response.status}`);
      const material = parseMaterial(await response.json(), response.url || address.href);
      if (material.image === "") throw new Error("the material has no image");
      if (stale()) return;
      this.#material = material;
    } catch (error) {
      if (!stale()) this.#end("failed", "material", error);
      return;
    }
    try {
      // An image of the same site that is also the poster is loaded only once.
      if (new URL(this.#material.image).origin !== location.origin) image.crossOrigin = "anonymous";
      else image.removeAttribute("crossorigin");
      image.src = this.#material.image;
      const decoded = image.decode();
      try {
        renderer();
      } catch {
        // Without WebGL 2 the plain image stays. The error is reported when the image is loaded.
      }
      if (this.#sounds) warmSound();
      await decoded;
      if (stale()) return;
    } catch (error) {
      if (!stale())
        this.#end("failed", "image", error instanceof Error ? `${this.#material.image}: ${error.message}` : error);
      return;
    }
    let kind: TriboErrorDetail["type"] = "wasm";
    try {
      const made = await engineReady;
      if (stale()) return;
      kind = "webgl";
      this.#renderer = renderer();
      this.#renderer.addEventListener("lost", this.#lose);
      this.#renderer.addEventListener("restored", this.#restore);
      const most = this.asPublished ? kPublishedNodes : kNodes;
      const scale = Math.min(1, most / Math.max(image.naturalWidth, image.naturalHeight));
      const nodesX = Math.max(1, Math.round(image.naturalWidth * scale));
      const nodesY = Math.max(1, Math.round(image.naturalHeight * scale));
      const spacingMm = this.#material.width_mm / nodesX;
      this.#sheet = made.sheet(nodesX, nodesY, spacingMm);
      this.#picture = { image, nodesX, nodesY, spacingMm, finish: this.asPublished ? undefined : this.#material };
      this.#renderer.add(this.#picture);
      this.#renderer.upload(this.#picture, this.#sheet.everything());
    } catch (error) {
      if (!stale()) this.#end("plain", kind, error);
      return;
    }
    this.#applyMaterial();
    await this.#loadMap().catch((error: unknown) => this.#fail("image", error));
    if (stale()) return;
    this.#end("ready");
    if (this.#voice === undefined) this.#makeVoice();
    // The first touch is lit as if the image were smooth.
    const { height_map, relief_slope } = this.#material;
    whenIdle(() => {
      if (stale()) return;
      this.#relieve(height_map, relief_slope).catch((error: unknown) => stale() || this.#fail("image", error));
    });
  }

  /** Computes the small relief from the image, or from a height map. */
  async #relieve(address: string, rmsSlope: number): Promise<void> {
    const picture = this.#picture;
    const made = await engine();
    if (picture?.finish === undefined) return;
    picture.relief = await smallRelief(picture, address, rmsSlope, made);
    this.#renderer?.relieve(picture);
    if (picture === this.#picture) animate(this);
  }

  #end(state: State, type?: TriboErrorDetail["type"], error?: unknown): void {
    this.#state = state;
    if (type !== undefined) {
      if (state !== "ready") this.#freeGraphics();
      this.#fail(type, error);
    }
    this.#describe();
    this.#resize();
    if (this.loaded) {
      if (this.reveal !== "manual") this.dismissPoster();
      this.dispatchEvent(new Event("load"));
    }
  }

  #applyMaterial(): void {
    if (this.#sheet !== undefined && !this.hasAttribute("stiffness-map")) {
      this.#sheet.setMaterial(this.stiffness, this.damping);
    }
  }

  async #loadMap(): Promise<void> {
    const address = this.getAttribute("stiffness-map");
    const sheet = this.#sheet;
    if (address === null || sheet === undefined) return;
    const levels = await stiffnessLevels(new URL(address, document.baseURI).href, sheet);
    if (sheet === this.#sheet) sheet.setMaterials(levels, stiffnessPalette(this.stiffness, this.damping));
  }

  get #sounds(): boolean {
    return !this.muted && this.getAttribute("sound") !== "off" && (this.#material?.voices.length ?? 0) > 0;
  }

  #makeVoice(): void {
    this.#voice?.free();
    this.#voice = undefined;
    this.#relief = undefined;
    if (!this.#sounds || !this.#sheet) return;
    const voice = new Voice(this.#material!, this.asPublished, (error) => {
      if (this.#voice === voice) this.#fail("audio", error);
    });
    this.#voice = voice;
    // The first rub may sound without it.
    whenIdle(() => {
      if (this.#voice !== voice) return;
      try {
        this.#relief = new Relief(this.#parts!.image);
      } catch {
        // An image of another site that must not be read.
      }
    });
  }

  #freeGraphics(): void {
    stop(this);
    this.#sheet?.free();
    this.#sheet = undefined;
    if (this.#picture !== undefined) this.#renderer?.free(this.#picture);
    this.#picture = undefined;
    this.#renderer?.removeEventListener("lost", this.#lose);
    this.#renderer?.removeEventListener("restored", this.#restore);
    this.#renderer = undefined;
    this.#parts?.surface.classList.remove("drawn");
    if (this.#parts !== undefined) this.#parts.canvas.width = this.#parts.canvas.height = 0;
  }

  #free(): void {
    ++this.#attempt;
    this.#liftAll();
    this.#freeGraphics();
    this.#voice?.free();
    this.#voice = undefined;
    this.#relief = undefined;
    this.#parts?.image.removeAttribute("src");
  }

  // The picture -------------------------------------------------------------------------------------------------

  #resize(): void {
    if (this.#picture === undefined || this.#parts === undefined) return;
    const { canvas, surface } = this.#parts;
    const ratio = Math.min(kMostPixelRatio, devicePixelRatio || 1);
    const width = Math.round(surface.clientWidth * ratio);
    const height = Math.round((width * this.#picture.nodesY) / this.#picture.nodesX);
    if (width > 0 && (canvas.width !== width || canvas.height !== height)) {
      canvas.width = width;
      canvas.height = height;
    }
    animate(this);
  }

  #contextLost(): void {
    this.#parts?.surface.classList.remove("drawn");
    stop(this);
  }

  #contextRestored(): void {
    if (this.#picture === undefined || this.#sheet === undefined) return;
    this.#renderer!.add(this.#picture);
    this.#renderer!.upload(this.#picture, this.#sheet.everything());
    animate(this);
  }

  /** Called by the animation loop of the page. */
  frame(now: number, seconds: number): boolean {
    const sheet = this.#sheet;
    const picture = this.#picture;
    if (sheet === undefined || picture === undefined || this.#context === null || this.#renderer!.lost) return false;
    const contacts = [...this.#fingers.values()].map((finger) => finger.contact(now));
    const hairy = !!picture.finish?.pile;
    sheet.press(contacts, this.asPublished, this.getAttribute("contact") === "point", hairy);
    const moving = sheet.step(seconds, this.asPublished);
    const changes = sheet.changes();
    if (changes !== null) this.#renderer!.upload(picture, changes);
    const leans = sheet.leans();
    if (leans !== null) this.#renderer!.lean(picture, leans);
    if (this.#context.canvas.width > 0) {
      const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
      const fullMm = kFullForceN / this.stiffness;
      if (this.#renderer!.draw(picture, this.#context, !still, fullMm)) this.#parts!.surface.classList.add("drawn");
    }
    this.#sound(now, seconds);
    for (const [id, finger] of this.#fingers) this.#tell("contact-move", id, finger, now * 1000);
    return (moving || this.#fingers.size > 0) && this.#visible;
  }

  #sound(now: number, seconds: number): void {
    let speed = 0;
    let force = 0;
    let u = 0.5;
    let v = 0.5;
    for (const finger of this.#fingers.values()) {
      if (finger.speed(now) < speed) continue;
      speed = finger.speed(now);
      force = finger.force(now);
      [u, v] = this.#place(finger);
    }
    const inside = u >= 0 && u <= 1 && v >= 0 && v <= 1;
    this.#voice?.target(inside ? speed : 0, force, clamp(2 * u - 1, -1, 1), this.#relief?.gain(u, v) ?? 1);
    if (speed > 0 && this.getAttribute("haptics") !== "off") this.#vibration.rub(speed, force, seconds, now);
  }

  // Fingers -----------------------------------------------------------------------------------------------------

  #place(finger: Finger): [number, number] {
    const { nodesX, nodesY, spacingMm } = this.#picture!;
    return [finger.x / (nodesX * spacingMm), finger.y / (nodesY * spacingMm)];
  }

  #tell(type: string, id: number, finger: Finger, timeStamp: number): void {
    const now = timeStamp / 1000;
    const [u, v] = this.#place(finger);
    const detail: ContactDetail = {
      u,
      v,
      timeStamp,
      depth_mm: this.#sheet?.depthAt(finger.x, finger.y) ?? 0,
      force_n: finger.force(now),
      area_mm2: finger.area,
      speed_mm_per_s: finger.speed(now),
      pointerType: this.#types.get(id) ?? "",
    };
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }

  #report(event: PointerEvent): FingerReport {
    const box = this.#parts!.surface.getBoundingClientRect();
    const { nodesX, spacingMm } = this.#picture!;
    const mmPerPixel = (nodesX * spacingMm) / Math.max(1, box.width);
    // A mouse, and a screen that does not measure, report one pixel.
    const size = (pixels: number) => (pixels > 1 ? pixels * mmPerPixel : 0);
    return {
      x: (event.clientX - box.left) * mmPerPixel,
      y: (event.clientY - box.top) * mmPerPixel,
      width: size(event.width),
      height: size(event.height),
      pressure: measuredPressure(event),
      time: event.timeStamp / 1000,
    };
  }

  #keyReport(u: number, v: number): FingerReport {
    const { nodesX, nodesY, spacingMm } = this.#picture!;
    return {
      x: u * nodesX * spacingMm,
      y: v * nodesY * spacingMm,
      width: 0,
      height: 0,
      pressure: Number.NaN,
      time: performance.now() / 1000,
    };
  }

  #touch(id: number, type: string, report: FingerReport, firmness = 1): Finger {
    const finger = new Finger(report);
    finger.firmness = firmness;
    this.#fingers.set(id, finger);
    this.#types.set(id, type);
    if (this.#voice === undefined) this.#makeVoice();
    this.#voice?.wake();
    this.dismissPoster();
    this.#tell("contact-start", id, finger, report.time * 1000);
    animate(this);
    return finger;
  }

  #down(event: PointerEvent): void {
    if (this.#picture === undefined || this.disabled || event.button !== 0) return;
    try {
      this.#parts!.surface.setPointerCapture(event.pointerId);
    } catch {
      // The pointer is already gone, or a script made it.
    }
    this.#keys!.show(false);
    this.#touch(event.pointerId, event.pointerType, this.#report(event));
  }

  #move(event: PointerEvent): void {
    const finger = this.#fingers.get(event.pointerId);
    if (finger === undefined || this.#picture === undefined) return;
    const reports = event.getCoalescedEvents?.() ?? [];
    const ahead = event.getPredictedEvents?.().at(-1);
    for (const one of reports.length > 0 ? reports : [event])
      finger.move(this.#report(one), ahead && this.#report(ahead));
  }

  #lift(id: number, timeStamp: number): void {
    const finger = this.#fingers.get(id);
    if (finger === undefined) return;
    if (this.#picture !== undefined) this.#tell("contact-end", id, finger, timeStamp);
    this.#fingers.delete(id);
    this.#types.delete(id);
    if (this.#fingers.size === 0) this.#voice?.target(0, 0, 0);
    animate(this);
  }

  #liftAll(): void {
    this.#keys?.lift();
    for (const id of this.#fingers.keys()) this.#lift(id, performance.now());
  }

  // Methods -----------------------------------------------------------------------------------------------------

  /** Removes the poster. Done automatically after loading, unless reveal is "manual". */
  dismissPoster(): void {
    if (this.#posterDismissed) return;
    this.#posterDismissed = true;
    if (this.#parts !== undefined) this.#parts.cover.hidden = true;
    this.dispatchEvent(new Event("poster-dismissed"));
  }

  showPoster(): void {
    this.#posterDismissed = false;
    if (this.#parts !== undefined) this.#parts.cover.hidden = false;
  }

  /** The current picture as a PNG; null if there is none yet. */
  toBlob(): Promise<Blob | null> {
    const canvas = this.#parts?.canvas;
    if (canvas === undefined || canvas.width === 0) return Promise.resolve(null);
    return new Promise((done) => canvas.toBlob(done));
  }
}

// SPDX-License-Identifier: MIT
// touch.wasm on the page: one instance for all elements, loaded once, when the first element needs it.

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  tribo_allocate(bytes: number): number;
  tribo_release(pointer: number): void;
  sheet_create(width: number, height: number, spacingMm: number): number;
  sheet_destroy(sheet: number): void;
  sheet_set_material(sheet: number, stiffness: number, viscosity: number): void;
  sheet_set_materials(sheet: number, levels: number, palette: number): void;
  sheet_contacts(sheet: number): number;
  sheet_press(sheet: number, count: number, point: number, published: number): void;
  sheet_step(sheet: number, seconds: number, published: number): number;
  sheet_reset(sheet: number): void;
  sheet_changes(sheet: number): number;
  sheet_heights(sheet: number): number;
  sheet_stride(sheet: number): number;
  sheet_small_relief(rgba: number, width: number, height: number, rmsSlope: number): void;
}

/** What touches the sheet; mm from the image's top left corner, newton, seconds. */
export interface Contact {
  x: number;
  y: number;
  halfWidth: number;
  halfHeight: number;
  force: number;
  held: number;
}

export interface Changes {
  x: number;
  y: number;
  width: number;
  height: number;
  /** Floats from row to row. */
  stride: number;
  /** From the first changed node on; valid until the next call of the engine. */
  values: Float32Array;
}

const kMostContacts = 16;
const kContactDoubles = 7;

export class Sheet {
  readonly width: number;
  readonly height: number;
  readonly spacingMm: number;
  #x: Exports;
  #handle: number;

  constructor(exports: Exports, width: number, height: number, spacingMm: number) {
    this.width = width;
    this.height = height;
    this.spacingMm = spacingMm;
    this.#x = exports;
    this.#handle = exports.sheet_create(width, height, spacingMm);
  }

  free(): void {
    if (this.#handle !== 0) this.#x.sheet_destroy(this.#handle);
    this.#handle = 0;
  }

  setMaterial(stiffness: number, viscosity: number): void {
    this.#x.sheet_set_material(this.#handle, stiffness, viscosity);
  }

  /** Levels: a byte a node; palette: stiffness and viscosity of each level. */
  setMaterials(levels: Uint8Array, palette: Float64Array): void {
    const at = this.#x.tribo_allocate(levels.length + 8 * palette.length + 16);
    const paletteAt = at + ((levels.length + 15) & ~15);
    new Uint8Array(this.#x.memory.buffer, at).set(levels);
    new Float64Array(this.#x.memory.buffer, paletteAt, palette.length).set(palette);
    this.#x.sheet_set_materials(this.#handle, at, paletteAt);
    this.#x.tribo_release(at);
  }

  press(contacts: Contact[], published: boolean, point = false): void {
    const count = Math.min(contacts.length, kMostContacts);
    const at = this.#x.sheet_contacts(this.#handle);
    const numbers = new Float64Array(this.#x.memory.buffer, at, kMostContacts * kContactDoubles);
    for (let i = 0; i < count; ++i) {
      const c = contacts[i]!;
      numbers.set([c.x, c.y, c.halfWidth, c.halfHeight, 0, c.force, c.held], i * kContactDoubles);
    }
    this.#x.sheet_press(this.#handle, count, Number(point), Number(published));
  }

  /** Lets time pass; false: nothing moves any more. */
  step(seconds: number, published: boolean): boolean {
    return this.#x.sheet_step(this.#handle, seconds, Number(published)) !== 0;
  }

  reset(): void {
    this.#x.sheet_reset(this.#handle);
  }

  /** What moved since the last call, or null. */
  changes(): Changes | null {
    const at = this.#x.sheet_changes(this.#handle);
    const [x, y, width, height] = new Int32Array(this.#x.memory.buffer, at, 4) as unknown as [
      number, number, number, number];
    if (width === 0) return null;
    return { x, y, width, height, ...this.#values(x, y, height) };
  }

  everything(): Changes {
    return { x: 0, y: 0, width: this.width, height: this.height, ...this.#values(0, 0, this.height) };
  }

  depthAt(x: number, y: number): number {
    const i = Math.min(this.width - 1, Math.max(0, Math.floor(x / this.spacingMm)));
    const j = Math.min(this.height - 1, Math.max(0, Math.floor(y / this.spacingMm)));
    return -(this.#values(i, j, 1).values[0] ?? 0);
  }

  #values(x: number, y: number, rows: number): { stride: number; values: Float32Array } {
    const stride = this.#x.sheet_stride(this.#handle);
    const at = this.#x.sheet_heights(this.#handle) + 4 * (y * stride + x);
    return { stride, values: new Float32Array(this.#x.memory.buffer, at, (rows - 1) * stride + this.width - x) };
  }
}

export interface Engine {
  module: WebAssembly.Module;
  sheet(width: number, height: number, spacingMm: number): Sheet;
  /** Writes the slopes of the pixels' small relief over their red and green. */
  smallRelief(pixels: ImageData, rmsSlope: number): void;
  /** Bytes of the module's memory. */
  memoryBytes(): number;
}

let loading: Promise<Engine> | undefined;

async function load(): Promise<Engine> {
  const response = await fetch(new URL("./touch.wasm", import.meta.url));
  if (!response.ok) throw new Error(`touch.wasm: HTTP ${response.status}`);
  // Not every server knows the MIME type that streaming compilation asks for.
  const module = await WebAssembly.compile(await response.arrayBuffer());
  const instance = await WebAssembly.instantiate(module, {});
  const exports = instance.exports as unknown as Exports;
  exports._initialize();
  return {
    module,
    sheet: (width, height, spacingMm) => new Sheet(exports, width, height, spacingMm),
    smallRelief({ data, width, height }, rmsSlope) {
      const at = exports.tribo_allocate(data.length);
      new Uint8Array(exports.memory.buffer, at).set(data);
      exports.sheet_small_relief(at, width, height, rmsSlope);
      data.set(new Uint8Array(exports.memory.buffer, at, data.length));
      exports.tribo_release(at);
    },
    memoryBytes: () => exports.memory.buffer.byteLength,
  };
}

/** The engine; a failed load is tried again by the next call. */
export function engine(): Promise<Engine> {
  loading ??= load().catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

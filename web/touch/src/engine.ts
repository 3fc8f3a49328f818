// SPDX-License-Identifier: MIT
// touch.wasm in the page: one instance for all elements, loaded when the first element needs it.
import { clamp } from "@tribo/ui/clamp";
import type { TouchExports } from "@tribo/wasm/exports";
import { bytesAt, doublesAt, floatsAt, lend } from "@tribo/wasm/memory";
import { compile, instantiate, type Compiled } from "@tribo/wasm/module";

/** Contacts on the sheet; mm from the top left corner of the image, newton, seconds. */
export interface Contact {
  x: number;
  y: number;
  halfWidth: number;
  halfHeight: number;
  force: number;
  held: number;
  /** Its way here since the last frame; absent: it has not moved. */
  dx?: number;
  dy?: number;
}

export interface Changes {
  x: number;
  y: number;
  width: number;
  height: number;
  /** Number of floats from row to row. */
  stride: number;
  /** Starts at the first changed node; valid until the next call of the engine. */
  values: Float32Array;
}

/** How the hairs of a pile lean: x and y of each node. */
export interface Leans {
  width: number;
  height: number;
  values: Float32Array;
}

const kMostContacts = 16;
const kContactDoubles = 7;
// Nodes of the sheet for each of the pile, along one side (src/elastic/pile.hpp).
const kPileNodes = 4;

export class Sheet {
  readonly width: number;
  readonly height: number;
  readonly spacingMm: number;
  #x: TouchExports;
  #handle: number;

  constructor(exports: TouchExports, width: number, height: number, spacingMm: number) {
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

  /** Levels: one byte per node; palette: stiffness and viscosity of each level. */
  setMaterials(levels: Uint8Array, palette: Float64Array): void {
    lend(this.#x, levels, (levelsAt) =>
      lend(this.#x, palette, (paletteAt) => this.#x.sheet_set_materials(this.#handle, levelsAt, paletteAt)),
    );
  }

  /** `brush`: there are hairs that a moving contact turns. */
  press(contacts: Contact[], published: boolean, point = false, brush = false): void {
    const count = Math.min(contacts.length, kMostContacts);
    const numbers = doublesAt(this.#x, this.#x.sheet_contacts(this.#handle), kMostContacts * kContactDoubles);
    for (let i = 0; i < count; ++i) {
      const c = contacts[i]!;
      numbers.set([c.x, c.y, c.halfWidth, c.halfHeight, 0, c.force, c.held], i * kContactDoubles);
    }
    this.#x.sheet_press(this.#handle, count, Number(point), Number(published));
    if (brush)
      contacts.slice(0, count).forEach(({ dx = 0, dy = 0 }, n) => this.#x.sheet_brush(this.#handle, n, dx, dy));
  }

  /** Advances the time. Returns false when nothing moves any more. */
  step(seconds: number, published: boolean): boolean {
    return this.#x.sheet_step(this.#handle, seconds, Number(published)) !== 0;
  }

  /** Null before the pile is brushed. Valid until the next call of the engine. */
  leans(): Leans | null {
    const at = this.#x.sheet_leans(this.#handle);
    const nodes = (ofSheet: number) => Math.max(1, Math.floor(ofSheet / kPileNodes));
    const width = nodes(this.width);
    const height = nodes(this.height);
    return at === 0 ? null : { width, height, values: floatsAt(this.#x, at, 2 * width * height) };
  }

  /** Region that moved since the last call, or null. */
  changes(): Changes | null {
    const at = this.#x.sheet_changes(this.#handle);
    const [x, y, width, height] = new Int32Array(this.#x.memory.buffer, at, 4) as unknown as [
      number,
      number,
      number,
      number,
    ];
    if (width === 0) return null;
    return { x, y, width, height, ...this.#values(x, y, height) };
  }

  everything(): Changes {
    return { x: 0, y: 0, width: this.width, height: this.height, ...this.#values(0, 0, this.height) };
  }

  depthAt(x: number, y: number): number {
    const i = clamp(Math.floor(x / this.spacingMm), 0, this.width - 1);
    const j = clamp(Math.floor(y / this.spacingMm), 0, this.height - 1);
    return -(this.#values(i, j, 1).values[0] ?? 0);
  }

  #values(x: number, y: number, rows: number): { stride: number; values: Float32Array } {
    const stride = this.#x.sheet_stride(this.#handle);
    const at = this.#x.sheet_heights(this.#handle) + 4 * (y * stride + x);
    return { stride, values: floatsAt(this.#x, at, (rows - 1) * stride + this.width - x) };
  }
}

export interface Engine {
  module: Compiled<TouchExports>;
  sheet(width: number, height: number, spacingMm: number): Sheet;
  /** Writes the slopes of the small relief to the red and green of the pixels. */
  smallRelief(pixels: ImageData, rmsSlope: number): void;
  /** Memory of the module in bytes. */
  memoryBytes(): number;
}

let loading: Promise<Engine> | undefined;

async function load(): Promise<Engine> {
  const module = await compile<TouchExports>("touch.wasm", import.meta.url);
  const exports = await instantiate(module);
  return {
    module,
    sheet: (width, height, spacingMm) => new Sheet(exports, width, height, spacingMm),
    smallRelief({ data, width, height }, rmsSlope) {
      lend(exports, data, (at) => {
        exports.sheet_small_relief(at, width, height, rmsSlope);
        data.set(bytesAt(exports, at, data.length));
      });
    },
    memoryBytes: () => exports.memory.buffer.byteLength,
  };
}

/** Returns the engine. After a failed load the next call tries again. */
export function engine(): Promise<Engine> {
  loading ??= load().catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

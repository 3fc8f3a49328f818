// SPDX-License-Identifier: MIT
// What the modules export (src/wasm/*.cpp has the contracts). Flags are 0 or 1; a handle of 0 is none.

/** A place in a module's memory. */
export type Address = number;

export interface AnyExports {
  readonly memory: WebAssembly.Memory;
  _initialize(): void;
}

/** Of every module that takes data in. */
export interface CommonExports extends AnyExports {
  /** Text, ended by a zero. */
  tribo_version(): Address;
  /** A multiple of 16. */
  tribo_allocate(bytes: number): Address;
  tribo_release(at: Address): void;
}

/** touch.wasm: sheets that yield, and friction voices. */
export interface TouchExports extends CommonExports {
  sheet_create(width: number, height: number, spacingMm: number): number;
  sheet_destroy(sheet: number): void;
  sheet_set_material(sheet: number, stiffness: number, viscosity: number): void;
  /** Levels: a byte a node; palette: 256 pairs of doubles, stiffness and viscosity. */
  sheet_set_materials(sheet: number, levels: Address, palette: Address): void;
  /** Where contacts are written before sheet_press: 7 doubles each. */
  sheet_contacts(sheet: number): Address;
  sheet_press(sheet: number, count: number, point: number, published: number): void;
  /** 1 while anything moves. */
  sheet_step(sheet: number, seconds: number, published: number): number;
  sheet_reset(sheet: number): void;
  /** x, y, width and height of what moved since the last call, as int32. */
  sheet_changes(sheet: number): Address;
  sheet_heights(sheet: number): Address;
  /** Floats from row to row. */
  sheet_stride(sheet: number): number;
  sheet_normals(sheet: number, axis: number): Address;
  sheet_small_relief(rgba: Address, width: number, height: number, rmsSlope: number): void;
  /** 0: voice_refusal() says why. */
  voice_create(numbers: Address, length: number, rate: number, seed: number, published: number): number;
  voice_refusal(): Address;
  voice_destroy(voice: number): void;
  voice_set_target(voice: number, speed: number, force: number): void;
  voice_render(voice: number, out: Address, frames: number): void;
  voice_gain(voice: number): number;
}

/** learn.wasm: voices out of recordings. */
export interface LearnExports extends CommonExports {
  learn_create(): number;
  learn_destroy(learning: number): void;
  /** Where the samples, doubles, are to be written before any other call. */
  learn_add(
    learning: number,
    name: Address,
    nameBytes: number,
    samples: number,
    rate: number,
    speed: number,
    force: number,
    channels: number,
    bits: number,
  ): Address;
  /** 1: learn_text() is the material file; 0: it says what is wrong. */
  learn_run(learning: number): number;
  learn_text(learning: number): Address;
  learn_warnings(learning: number): Address;
}

/** tribo.wasm: a mill without an engine. */
export interface MillExports extends CommonExports {
  mill_put_file(name: Address, nameLength: number, bytes: Address, length: number): void;
  mill_forget_files(): void;
  /** 1: opened; 0: refused. mill_text() has the warnings or the reason. */
  mill_open(name: Address, nameLength: number, part: Address, partLength: number, cell: number): number;
  mill_text(): Address;
  /** An operation and what it brings along. 1: obeyed; 0: refused, mill_text() says why. */
  mill_command(
    op: Address,
    opLength: number,
    value: number,
    on: number,
    x: number,
    y: number,
    z: number,
    word: Address,
    wordLength: number,
  ): number;
  /** What is set, as an engine tells a page, as JSON; of an open mill. */
  mill_settings(): Address;
  /** All materials that are known, one a line. */
  mill_materials(): Address;
  /** Bytes of frames at mill_frames(); -1: mill_text() says what is wrong. */
  mill_tick(seconds: number, looks: number): number;
  mill_frames(): Address;
}

/** mill_sound.wasm: what is heard of a cut. */
export interface MillSoundExports extends CommonExports {
  sound_open(rate: number): number;
  sound_take(frame: Address, length: number): void;
  sound_follow(time: number, speed: number, playing: number, lead: number): void;
  /** At most 1024 frames: floats, left and right by turns. */
  sound_render(frames: number): Address;
  sound_program_s(): number;
}

/** golden.wasm: the hashes that all builds agree on (tests/golden). */
export interface GoldenExports extends AnyExports {
  golden_count(): number;
  golden_name(index: number): Address;
  golden_hash(index: number): bigint;
}

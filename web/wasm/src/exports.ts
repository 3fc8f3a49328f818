// SPDX-License-Identifier: MIT
// The exports of the modules (contracts: src/wasm/*.cpp). Flags are 0 or 1; a handle of 0 is none.

/** An address in the memory of a module. */
export type Address = number;

export interface AnyExports {
  readonly memory: WebAssembly.Memory;
  _initialize(): void;
}

/** Exports of every module that takes data. */
export interface CommonExports extends AnyExports {
  /** Text with a terminating zero. */
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
  /** Levels: one byte per node; palette: 256 pairs of doubles, stiffness and viscosity. */
  sheet_set_materials(sheet: number, levels: Address, palette: Address): void;
  /** Address for contacts before sheet_press: 7 doubles each. */
  sheet_contacts(sheet: number): Address;
  sheet_press(sheet: number, count: number, point: number, published: number): void;
  /** Contact `n` has moved by (dx, dy) mm and brushed the pile. */
  sheet_brush(sheet: number, n: number, dx: number, dy: number): void;
  /** x and y of the lean of each node of the pile; 0 before the first brush. */
  sheet_leans(sheet: number): Address;
  /** 1 while anything moves. */
  sheet_step(sheet: number, seconds: number, published: number): number;
  /** x, y, width and height of the region that moved since the last call, as int32. */
  sheet_changes(sheet: number): Address;
  sheet_heights(sheet: number): Address;
  /** Number of floats from row to row. */
  sheet_stride(sheet: number): number;
  sheet_small_relief(rgba: Address, width: number, height: number, rmsSlope: number): void;
  /** 0: refused; voice_refusal() gives the reason. */
  voice_create(numbers: Address, length: number, rate: number, seed: number, published: number): number;
  voice_refusal(): Address;
  voice_destroy(voice: number): void;
  voice_set_target(voice: number, speed: number, force: number): void;
  voice_render(voice: number, out: Address, frames: number): void;
  voice_gain(voice: number): number;
}

/** learn.wasm: voices from recordings. */
export interface LearnExports extends CommonExports {
  learn_create(): number;
  learn_destroy(learning: number): void;
  /** Address for the samples, doubles, to be written before any other call. */
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
  /** 1: learn_text() is the material file; 0: learn_text() is the error. */
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
  /** An operation and its values. 1: executed; 0: refused, mill_text() has the reason. */
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
  /** The settings of the open mill as JSON, as sent by an engine. */
  mill_settings(): Address;
  /**
   * Audits what is milled so far, with the settings of the open mill. 1: mill_text() is an AuditOfMill as JSON and
   * mill_audit_lines() has its lines; 0: mill_text() has the reason.
   */
  mill_audit(): number;
  /** `lines` times AUDIT_COLUMNS.length doubles, in the order of time. */
  mill_audit_lines(): Address;
  /** Keeps the open mill aside, for mill_volumes() and mill_join(). */
  mill_keep(): void;
  /** Two doubles: the material that only the part kept has, and that only the part of the open mill has, mm3. */
  mill_volumes(): Address;
  /** Joins the rows of the mill kept and of the open one. The number of pairs; mill_text(): by what, tab, width of a step. */
  mill_join(): number;
  /** The pairs: joined.ts. */
  mill_joined(): Address;
  /** What is compared of a stretch, one per line: name, tab, unit. */
  mill_quantities(): Address;
  /** All known materials, one per line. */
  mill_materials(): Address;
  /** All known machines, separated by ", ". */
  mill_machines(): Address;
  /** 1: mill_text() is the job that stands for a program; 0: mill_text() has the reason. */
  mill_job_text(name: Address, nameLength: number): number;
  /** Number of bytes at mill_frames(). */
  mill_tick(seconds: number, looks: number): number;
  mill_frames(): Address;
}

/** mill_sound.wasm: the sound of a cut. */
export interface MillSoundExports extends CommonExports {
  sound_open(rate: number): number;
  sound_take(frame: Address, length: number): void;
  sound_follow(time: number, speed: number, playing: number, lead: number): void;
  /** At most 1024 frames: floats, left and right interleaved. */
  sound_render(frames: number): Address;
  sound_program_s(): number;
}

/** golden.wasm: the hashes that are equal in all builds (tests/golden). */
export interface GoldenExports extends AnyExports {
  golden_count(): number;
  golden_name(index: number): Address;
  golden_hash(index: number): bigint;
}

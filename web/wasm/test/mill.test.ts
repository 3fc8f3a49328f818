// SPDX-License-Identifier: MIT
// The mill of a page in Node.js: the plate of the examples comes out as it does natively
// (tests/session/live_plate_test.cpp), its sound has the line of its teeth, and wrong files are refused in words.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { BENDING_SLOT, SLOT_PROGRAM } from "../../testing/job.js";
import { ROOT } from "../../tools/places.js";
import { AUDIT_COLUMNS, auditOf, type AuditColumn } from "../src/audit.js";
import type { MillExports, MillSoundExports } from "../src/exports.js";
import { bytesAt, floatsAt, lend, lendText, textAt } from "../src/memory.js";
import { AS_MANY_AS_NEEDED, openMill, putFile, tickMill } from "../src/mill.js";
import { obey, type MillCommand } from "../src/mill_command.js";
import { load } from "./load.js";
const SLOT = "G21 G90 S6000 F600\nG0 X-10 Y0 Z5\nG1 Z-2\nG1 X60\n";
const RATE = 48000;

class Mill {
  static async open(): Promise<Mill> {
    return new Mill(await load<MillExports>("tribo"));
  }
  constructor(readonly x: MillExports) {}
  said(): string {
    return textAt(this.x, this.x.mill_text());
  }
  file(name: string, content: string | Uint8Array): void {
    putFile(this.x, name, content);
  }
  /** Whether it takes the job or the program; said() tells why not. */
  take(name: string, cell = 0): boolean {
    return openMill(this.x, name, "", cell);
  }
  /** Whether it obeys; said() tells why not. */
  command(command: MillCommand): boolean {
    return obey(this.x, command);
  }
  /** The job that stands for a program; undefined: said() tells why there is none. */
  jobText(name: string): string | undefined {
    return lendText(this.x, name, (...job) => this.x.mill_job_text(...job)) === 1 ? this.said() : undefined;
  }
  settings(): unknown {
    return JSON.parse(textAt(this.x, this.x.mill_settings()));
  }
  audit(): ReturnType<typeof auditOf> {
    return auditOf(this.x);
  }
  /** Frames of a tick, as bytes. */
  tick(seconds: number, looks: number): Uint8Array[] {
    return tickMill(this.x, seconds, looks).map((frame) => new Uint8Array(frame));
  }
}

const FNV_BEGIN = 0xcbf29ce484222325n;

/** FNV-1a, 64 bits, going on from `before`. */
function fnv(bytes: Uint8Array, before = FNV_BEGIN): bigint {
  // In two halves: BigInt for every byte would take minutes.
  let low = Number(before & 0xffffffffn);
  let high = Number(before >> 32n);
  for (const byte of bytes) {
    low = (low ^ byte) >>> 0;
    // times 0x100000001b3, modulo 2^64
    const a = (low & 0xffff) * 0x1b3;
    const b = (low >>> 16) * 0x1b3 + (a >>> 16);
    const carry = Math.floor(((low >>> 16) * 0x1b3 + Math.floor(((low & 0xffff) * 0x1b3) / 65536)) / 65536);
    high = (Math.imul(high, 0x1b3) + carry + (low << 8)) >>> 0;
    low = (((b & 0xffff) << 16) | (a & 0xffff)) >>> 0;
  }
  return (BigInt(high) << 32n) | BigInt(low);
}

test("the plate comes out of the module as it does natively", async () => {
  const mill = await Mill.open();
  for (const name of ["plate.toml", "plate.nc"]) mill.file(name, readFileSync(join(ROOT, "examples/plate", name)));
  expect(mill.take("plate.toml", 0.25), mill.said()).toBe(true);
  mill.command({ op: "seek", t_s: 1e9 });
  const chunks = new Map<string, bigint>();
  const rough = new Set<string>();
  const sounds: Uint8Array[] = [];
  do {
    for (const frame of mill.tick(0, AS_MANY_AS_NEEDED)) {
      if (frame[0] === 6) sounds.push(frame);
      if (frame[0] !== 2) continue;
      const key = new Int32Array(frame.buffer, 16, 3).join();
      chunks.set(key, fnv(frame.subarray(28)));
      const isRough = new DataView(frame.buffer).getUint32(frame.byteLength - 4, true) !== 0;
      if (isRough) rough.add(key);
      else rough.delete(key);
    }
  } while (rough.size > 0);
  let sum = 0n;
  for (const hash of chunks.values()) sum += hash;
  const golden = readFileSync(join(ROOT, "tests/golden/plate.txt"), "utf8").trim();
  expect(BigInt.asUintN(64, sum).toString(16).padStart(16, "0")).toBe(golden);
  expect(sounds.length).toBeGreaterThan(10);
});

test("the plate sounds in the modules as it does natively", async () => {
  const mill = await Mill.open();
  for (const name of ["plate.toml", "plate.nc"]) mill.file(name, readFileSync(join(ROOT, "examples/plate", name)));
  expect(mill.take("plate.toml", 0.25), mill.said()).toBe(true);
  const ear = await load<MillSoundExports>("mill_sound");
  expect(ear.sound_open(RATE)).toBe(1);
  mill.command({ op: "seek", t_s: 10 });
  mill.command({ op: "play" });
  let hash = FNV_BEGIN;
  for (let picture = 0; picture < 120; ++picture) {
    let state: DataView | undefined;
    for (const frame of mill.tick(1 / 60, AS_MANY_AS_NEEDED)) {
      lend(ear, frame, (at, length) => ear.sound_take(at, length));
      if (frame[0] === 3) state = new DataView(frame.buffer);
    }
    const playing = state!.getUint32(state!.byteLength - 4, true) & 2;
    ear.sound_follow(state!.getFloat64(8, true), state!.getFloat32(80, true), playing, 0);
    hash = fnv(bytesAt(ear, ear.sound_render(800), 6400), hash);
  }
  const golden = readFileSync(join(ROOT, "tests/golden/plate_sound.txt"), "utf8").trim();
  expect(hash.toString(16).padStart(16, "0")).toBe(golden);
});

test("the plate is audited in the module as it is natively", async () => {
  const mill = await Mill.open();
  for (const name of ["plate.toml", "plate.nc"]) mill.file(name, readFileSync(join(ROOT, "examples/plate", name)));
  expect(mill.take("plate.toml", 0.25), mill.said()).toBe(true);
  mill.command({ op: "seek", t_s: 1e9 });
  mill.tick(0, AS_MANY_AS_NEEDED);
  const { text, lines } = mill.audit();
  const hash = fnv(new Uint8Array(lines.buffer), fnv(new TextEncoder().encode(text)));
  const golden = readFileSync(join(ROOT, "tests/golden/plate_audit.txt"), "utf8").trim();
  expect(hash.toString(16).padStart(16, "0")).toBe(golden);
});

test("an audit follows limits, milling and overrides", async () => {
  const mill = await Mill.open();
  expect(() => mill.audit()).toThrow(/no job is open/);
  mill.file("s.nc", SLOT);
  const job = ["[stock]", "box_mm = [[0, -20, -10], [50, 20, 0]]", "[cutter]", 'kind = "flat"', "diameter_mm = 10"];
  const limits = ["[material]", 'name = "al7075-t6"', "[path]", 'gcode = "s.nc"', "[limits]", "force_n = 10"];
  mill.file("s.toml", [...job, ...limits].join("\n"));
  expect(mill.take("s.toml", 0.5), mill.said()).toBe(true);
  const before = mill.audit();
  expect(before.audit.verdict.outcome).toBe("nothing cut");
  mill.command({ op: "seek", t_s: 1e9 });
  mill.tick(0, AS_MANY_AS_NEEDED);
  const at = (name: AuditColumn, { lines }: { lines: Float64Array }) => {
    const column = AUDIT_COLUMNS.indexOf(name);
    return Math.max(...Array.from(lines).filter((_, n) => n % AUDIT_COLUMNS.length === column));
  };
  const after = mill.audit();
  expect(after.lines.length).toBe(after.audit.lines * AUDIT_COLUMNS.length);
  expect(after.audit.verdict.outcome).toBe("over");
  expect(after.audit.verdict.sentence).toMatch(/^No: line 4, .*the force is too large/);
  const [tool] = after.audit.tools;
  expect(tool!.limits.peak_force_n).toEqual({ value: 10, from: "[limits] of the job" });
  expect(tool!.peak_force_n!.line).toBe(4);
  expect(after.audit.worst[0]!.line).toBe(4);
  expect(at("peak_force_n", after)).toBe(tool!.peak_force_n!.value);
  expect(at("peak_force_n_ratio", after)).toBeCloseTo(tool!.peak_force_n!.value / 10, 12);
  expect(at("feed_mm", after)).toBeCloseTo(70, 9);
  // Twice the feed: twice the chip, more than one and a half times the force.
  expect(mill.command({ op: "set", key: "feed_percent", value: 200 })).toBe(true);
  const faster = mill.audit();
  expect(at("chip_mm", faster)).toBeCloseTo(2 * at("chip_mm", after), 9);
  const ratio = at("peak_force_n", faster) / at("peak_force_n", after);
  expect(ratio).toBeGreaterThan(1.5);
  expect(ratio).toBeLessThan(2);
});

test("a second set-up mills on where the first one stopped", async () => {
  const mill = await Mill.open();
  const text = (lines: string[]) => lines.join("\n");
  const rest = ["[cutter]", 'kind = "flat"', "diameter_mm = 6", "[material]", 'name = "al7075-t6"', "[path]"];
  mill.file("a.nc", text(["G21 G90 M3 S6000 F600", "G0 X-5 Y10 Z-2", "G1 X35"]));
  mill.file("a.toml", text(["[stock]", "box_mm = [[0, 0, -10], [30, 20, 0]]", ...rest, 'gcode = "a.nc"']));
  const second = (from: string) => text(["[stock]", `from = "${from}"`, ...rest, 'gcode = "a.nc"']);
  mill.file("b.toml", second("a.toml"));
  // The same slot again meets nothing: no row of a cut comes, which is frame 4.
  const rows = (job: string) => {
    expect(mill.take(job, 0.5), mill.said()).toBe(true);
    mill.command({ op: "seek", t_s: 1e9 });
    return mill.tick(0, AS_MANY_AS_NEEDED).filter((frame) => frame[0] === 4).length;
  };
  expect(rows("a.toml")).toBeGreaterThan(0);
  expect(rows("b.toml")).toBe(0);
  for (const [from, words] of [
    ["b.toml", /begins with the stock that it leaves itself/],
    ["gone.toml", /not here/],
    ["out", /a page takes the stock from a job alone/],
  ] as const) {
    mill.file("b.toml", second(from));
    expect(mill.take("b.toml", 0.5)).toBe(false);
    expect(mill.said()).toMatch(words);
  }
});

// Amplitude of a tone in the left channel of what the ear gives.
function tone(samples: number[], hz: number): number {
  let re = 0;
  let im = 0;
  samples.forEach((v, n) => {
    re += v * Math.cos((2 * Math.PI * hz * n) / RATE);
    im -= v * Math.sin((2 * Math.PI * hz * n) / RATE);
  });
  return (2 * Math.hypot(re, im)) / samples.length;
}

// Seconds of a slot in the ear, the clock stopped after four of them. `alone`: without machine, chips and room.
async function slotHeard(alone: boolean): Promise<number[]> {
  const mill = await Mill.open();
  mill.file("s.nc", SLOT);
  expect(mill.take("s.nc"), mill.said()).toBe(true);
  const ear = await load<MillSoundExports>("mill_sound");
  expect(ear.sound_open(RATE)).toBe(1);
  expect(ear.sound_open(8000)).toBe(0);
  const heard: number[] = [];
  const follow = (frames: Uint8Array[]) => {
    for (const frame of frames) {
      const view = new DataView(frame.buffer);
      if (frame[0] === 10 && alone) frame.fill(0, 56, 68);
      if (frame[0] === 6 || frame[0] === 10) {
        lend(ear, frame, (at, length) => ear.sound_take(at, length));
      } else if (frame[0] === 3) {
        const flags = view.getUint32(frame.length - 4, true);
        ear.sound_follow(view.getFloat64(8, true), view.getFloat32(80, true), flags & 2, 0);
      }
    }
  };
  const render = () => {
    const samples = floatsAt(ear, ear.sound_render(800), 1600);
    for (let n = 0; n < 800; ++n) heard.push(samples[2 * n]!);
  };
  follow(mill.tick(0, 1));
  mill.command({ op: "play" });
  for (let n = 0; n < 240; ++n) {
    follow(mill.tick(1 / 60, AS_MANY_AS_NEEDED));
    render();
  }
  mill.command({ op: "pause" });
  for (let n = 0; n < 60; ++n) {
    follow(mill.tick(1 / 60, AS_MANY_AS_NEEDED));
    render();
  }
  return heard;
}

test("a slot sounds at the frequency of its teeth, and stops where it is paused", async () => {
  const alone = await slotHeard(true);
  const second = alone.slice(3 * RATE, 4 * RATE);
  const line = tone(second, 200);
  expect(line).toBeGreaterThan(0.01);
  for (const hz of [100, 150, 250, 300, 350]) expect(tone(second, hz), `${hz} Hz`).toBeLessThan(0.02 * line);
  // By default there is a machine around it, whose noise is louder than its teeth.
  const usual = await slotHeard(false);
  const rms = (x: number[]) => Math.hypot(...x) / Math.sqrt(x.length);
  const loud = rms(usual.slice(3 * RATE, 4 * RATE));
  expect(loud).toBeGreaterThan(0.03);
  expect(loud).toBeLessThan(0.3);
  expect(tone(usual.slice(3 * RATE, 4 * RATE), 200)).toBeGreaterThan(1e-3);
  for (const heard of [alone, usual]) expect(Math.max(...heard.slice(-24000).map(Math.abs))).toBe(0);
});

// The largest amplitude from 500 to 1500 Hz beside the harmonics of the teeth.
function chatterLine(samples: number[], toothHz: number): number {
  const smooth = samples.map((v, n) => v * (1 - Math.cos((2 * Math.PI * (n + 0.5)) / samples.length)));
  let most = 0;
  for (let hz = 500; hz < 1500; hz += 4) {
    const off = hz % toothHz;
    if (Math.min(off, toothHz - off) > 45) most = Math.max(most, tone(smooth, hz));
  }
  return most;
}

test("an override of the spindle is heard within 100 ms where a cut chatters", async () => {
  const mill = await Mill.open();
  mill.file("slot.toml", BENDING_SLOT);
  mill.file("slot.nc", SLOT_PROGRAM);
  expect(mill.take("slot.toml", 0.5), mill.said()).toBe(true);
  const ear = await load<MillSoundExports>("mill_sound");
  expect(ear.sound_open(RATE)).toBe(1);
  const play = (pictures: number) => {
    const heard: number[] = [];
    for (let n = 0; n < pictures; ++n) {
      let state: DataView | undefined;
      for (const frame of mill.tick(1 / 60, AS_MANY_AS_NEEDED)) {
        if ([6, 10, 13].includes(frame[0]!)) lend(ear, frame, (at, length) => ear.sound_take(at, length));
        if (frame[0] === 3) state = new DataView(frame.buffer);
      }
      // Flags come after 100 bytes.
      if (state)
        ear.sound_follow(state.getFloat64(8, true), state.getFloat32(80, true), state.getUint32(92, true) & 2, 0);
      const samples = floatsAt(ear, ear.sound_render(800), 1600);
      for (let k = 0; k < 800; ++k) heard.push(samples[2 * k]!);
    }
    return heard;
  };
  mill.command({ op: "seek", t_s: 0.9 });
  mill.command({ op: "play" });
  play(36);
  const howl = play(12);
  const loud = chatterLine(howl, 800 / 3);
  expect(loud).toBeGreaterThan(0.5 * tone(howl, 800 / 3));
  expect(mill.command({ op: "set", key: "spindle_percent", value: 112.5 })).toBe(true);
  play(6);
  const hum = play(12);
  expect(chatterLine(hum, 300)).toBeLessThan(0.1 * loud);
  expect(tone(hum, 300)).toBeGreaterThan(3 * chatterLine(hum, 300));
});

test("what is pressed into the part is pushed back", async () => {
  const mill = await Mill.open();
  mill.file("s.nc", SLOT);
  expect(mill.take("s.nc", 0.5), mill.said()).toBe(true);
  let felt: DataView = new DataView(new ArrayBuffer(64));
  const tick = () => {
    for (const frame of mill.tick(1 / 60, 100)) if (frame[0] === 7) felt = new DataView(frame.buffer);
  };
  mill.command({ op: "finger", position_mm: [30, 0, 1], down: true });
  for (let n = 0; n < 30; ++n) tick();
  expect(felt.getUint32(56, true) & 1, "contact above the part").toBe(0);
  mill.command({ op: "finger", position_mm: [30, 0, -1], down: true });
  for (let n = 0; n < 60; ++n) tick();
  expect(felt.getUint32(56, true) & 1).toBe(1);
  const force = felt.getFloat32(48, true);
  const probe = felt.getFloat32(24, true);
  expect(force).toBeGreaterThan(0.1);
  // Held above where the hand wants it.
  expect(probe).toBeGreaterThan(-1);
  mill.command({ op: "stop" });
  for (let n = 0; n < 10; ++n) tick();
  expect(felt.getFloat32(48, true), "force while stopped").toBe(0);
});

test("commands are obeyed or refused as an engine does", async () => {
  const mill = await Mill.open();
  expect(mill.command({ op: "play" })).toBe(false);
  expect(mill.said()).toMatch(/no job is open/);
  for (const name of ["plate.toml", "plate.nc"]) mill.file(name, readFileSync(join(ROOT, "examples/plate", name)));
  expect(mill.take("plate.toml", 0.5), mill.said()).toBe(true);
  const before = mill.settings() as { material: string };
  expect(before).toMatchObject({ op: "settings", feed_percent: 100, mode: "cut", force: true, stopped: false });
  expect(before.material).not.toBe("");
  expect(mill.command({ op: "set", key: "feed_percent", value: 150 })).toBe(true);
  expect(mill.command({ op: "material", value: "ti6al4v" })).toBe(true);
  expect(mill.command({ op: "mode", value: "inspect" })).toBe(true);
  const after = { ...before, feed_percent: 150, material: "ti6al4v", mode: "inspect" };
  expect(mill.settings()).toEqual(after);
  for (const [wrong, why] of [
    [{ op: "set", key: "feed_percent", value: 301 }, /'feed_percent' is out of range/],
    [{ op: "material", value: "unobtainium" }, /unobtainium/],
    [{ op: "fly" }, /'fly' is not known/],
    [{ op: "seek" }, /'seek' needs a number/],
    [{ op: "mode", value: "fly" }, /'fly' is no mode/],
  ] as const) {
    expect(mill.command(wrong)).toBe(false);
    expect(mill.said()).toMatch(why);
  }
  expect(mill.settings()).toEqual(after);
});

test("wrong files are refused with their place", async () => {
  const mill = await Mill.open();
  const refused = (name: string, text: string, what: RegExp) => {
    mill.file(name, text);
    expect(mill.take(name)).toBe(false);
    expect(mill.said()).toMatch(what);
  };
  refused("empty.toml", "", /^empty\.toml:1:1: error: the job is empty/);
  refused("a.toml", "[stok]\n", /^a\.toml:1:2: error: unknown key 'stok'.*\[?stock/);
  refused("a.nc", "G1 X[\n", /^a\.nc:1:/);
  refused("a.csv", "x,y,z,i,j,k\n1,2,3\n", /^a\.csv:2:/);
  refused("a.bin", "\0\0\0", /neither a job nor a program/);
  refused("a.apt", "GOTO/1,2\n", /^a\.apt:1:/);
});

test("a program has a job that stands for it, also before its machine is known", async () => {
  const mill = await Mill.open();
  mill.file("slot.nc", SLOT);
  const text = mill.jobText("slot.nc")!;
  expect(text).toContain('gcode = "slot.nc"');
  mill.file("slot.toml", text);
  expect(mill.take("slot.toml")).toBe(true);
  mill.file("five.nc", "G21 G90 S8000 M3\nG0 X0 Y0 Z5 A0 C0\nG1 Z-1 A10 C20 F300\nX30 A20\n");
  expect(mill.take("five.nc")).toBe(false);
  // The page asks for the machine where it finds these words.
  expect(mill.said()).toContain("without a machine");
  const machines = textAt(mill.x, mill.x.mill_machines()).split(", ");
  expect(machines.length).toBeGreaterThan(10);
  expect(machines).toContain("xyzac-trt");
  mill.file("five.toml", `${mill.jobText("five.nc")!}machine = "xyzac-trt"\n`);
  expect(mill.take("five.toml"), mill.said()).toBe(true);
  expect(mill.jobText("slot.toml")).toBeUndefined();
  expect(mill.jobText("none.nc")).toBeUndefined();
});

// SPDX-License-Identifier: MIT
// The mill of a page in Node: the plate of the examples comes out as it does natively
// (tests/session/live_plate_test.cpp), its sound has the line of its teeth, and wrong files are refused in words.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

const folder = process.env.TRIBO_WASM_DIR ?? new URL("../../build/wasm", import.meta.url).pathname;
const root = new URL("../../", import.meta.url);

async function load(name) {
  const module = await WebAssembly.compile(await readFile(`${folder}/${name}.wasm`));
  assert.deepEqual(WebAssembly.Module.imports(module), [], `${name}.wasm imports something`);
  const { exports } = await WebAssembly.instantiate(module, {});
  exports._initialize();
  return exports;
}

class Mill {
  constructor(x) {
    this.x = x;
  }
  put(bytes) {
    const at = this.x.tribo_allocate(bytes.length);
    new Uint8Array(this.x.memory.buffer, at, bytes.length).set(bytes);
    return [at, bytes.length];
  }
  string(text) {
    return this.put(new TextEncoder().encode(text));
  }
  said() {
    const memory = new Uint8Array(this.x.memory.buffer, this.x.mill_text());
    return new TextDecoder().decode(memory.subarray(0, memory.indexOf(0)));
  }
  file(name, bytes) {
    this.x.mill_put_file(...this.string(name), ...this.put(bytes));
  }
  open(name, cell = 0) {
    return this.x.mill_open(...this.string(name), ...this.string(""), cell) === 1;
  }
  // Frames of a tick, as bytes.
  tick(seconds, looks) {
    const length = this.x.mill_tick(seconds, looks);
    assert.ok(length >= 0, this.said());
    const at = this.x.mill_frames(), view = new DataView(this.x.memory.buffer), frames = [];
    for (let n = 0; n < length; ) {
      const bytes = view.getUint32(at + n, true);
      frames.push(new Uint8Array(this.x.memory.buffer.slice(at + n + 8, at + n + 8 + bytes)));
      n += 8 + 8 * Math.ceil(bytes / 8);
    }
    return frames;
  }
}

function fnv(bytes) {
  // In two halves: BigInt for every byte would take minutes.
  let low = 0x84222325, high = 0xcbf29ce4;
  for (const byte of bytes) {
    low = (low ^ byte) >>> 0;
    // times 0x100000001b3, modulo 2^64
    const a = (low & 0xffff) * 0x1b3, b = (low >>> 16) * 0x1b3 + (a >>> 16);
    const carry = Math.floor(((low >>> 16) * 0x1b3 + Math.floor(((low & 0xffff) * 0x1b3) / 65536)) / 65536);
    high = (Math.imul(high, 0x1b3) + carry + (low << 8)) >>> 0;
    low = (((b & 0xffff) << 16) | (a & 0xffff)) >>> 0;
  }
  return (BigInt(high) << 32n) | BigInt(low);
}

test("the plate comes out of the module as it does natively", async () => {
  const mill = new Mill(await load("tribo"));
  for (const name of ["plate.toml", "plate.nc"]) mill.file(name, await readFile(new URL(`examples/plate/${name}`, root)));
  assert.ok(mill.open("plate.toml", 0.25), mill.said());
  mill.x.mill_seek(1e9);
  const chunks = new Map(), sounds = [];
  for (const frame of mill.tick(0, 0xffffffff)) {
    if (frame[0] === 2) chunks.set(new Int32Array(frame.buffer, 16, 3).join(), fnv(frame.subarray(28)));
    if (frame[0] === 6) sounds.push(frame);
  }
  let sum = 0n;
  for (const hash of chunks.values()) sum += hash;
  const golden = (await readFile(new URL("tests/golden/plate.txt", root), "utf8")).trim();
  assert.equal(BigInt.asUintN(64, sum).toString(16).padStart(16, "0"), golden);
  assert.ok(sounds.length > 10);
});

test("a second set-up mills on where the first one stopped", async () => {
  const mill = new Mill(await load("tribo"));
  const text = (lines) => new TextEncoder().encode(lines.join("\n"));
  const rest = ['[cutter]', 'kind = "flat"', 'diameter_mm = 6', '[material]', 'name = "al7075-t6"', '[path]'];
  mill.file("a.nc", text(["G21 G90 M3 S6000 F600", "G0 X-5 Y10 Z-2", "G1 X35"]));
  mill.file("a.toml", text(["[stock]", "box_mm = [[0, 0, -10], [30, 20, 0]]", ...rest, 'gcode = "a.nc"']));
  const second = (from) => text(["[stock]", `from = "${from}"`, ...rest, 'gcode = "a.nc"']);
  mill.file("b.toml", second("a.toml"));
  // The same slot again meets nothing: no row of a cut comes, which is frame 4.
  const rows = (job) => {
    assert.ok(mill.open(job, 0.5), mill.said());
    mill.x.mill_seek(1e9);
    return mill.tick(0, 0xffffffff).filter((frame) => frame[0] === 4).length;
  };
  assert.ok(rows("a.toml") > 0);
  assert.equal(rows("b.toml"), 0);
  for (const [from, words] of [["b.toml", /begins with the stock that it leaves itself/], ["gone.toml", /not here/], ["out", /a page takes the stock from a job alone/]]) {
    mill.file("b.toml", second(from));
    assert.equal(mill.open("b.toml", 0.5), false);
    assert.match(mill.said(), words);
  }
});

// Amplitude of a tone in the left channel of what the ear gives.
function tone(samples, hz, rate) {
  let re = 0, im = 0;
  samples.forEach((v, n) => {
    re += v * Math.cos((2 * Math.PI * hz * n) / rate);
    im -= v * Math.sin((2 * Math.PI * hz * n) / rate);
  });
  return (2 * Math.hypot(re, im)) / samples.length;
}

// Seconds of a slot in the ear, the clock stopped after four of them. `alone`: without machine, chips and room.
async function slotHeard(alone) {
  const mill = new Mill(await load("tribo"));
  mill.file("s.nc", new TextEncoder().encode("G21 G90 S6000 F600\nG0 X-10 Y0 Z5\nG1 Z-2\nG1 X60\n"));
  assert.ok(mill.open("s.nc"), mill.said());
  const ear = await load("mill_sound"), RATE = 48000;
  assert.equal(ear.sound_open(RATE), 1);
  assert.equal(ear.sound_open(8000), 0);
  const inbox = ear.tribo_allocate(1 << 18), heard = [];
  const follow = (frames) => {
    for (const frame of frames) {
      const view = new DataView(frame.buffer);
      if (frame[0] === 10 && alone) frame.fill(0, 56, 68);
      if ([6, 10].includes(frame[0])) {
        new Uint8Array(ear.memory.buffer, inbox, frame.length).set(frame);
        ear.sound_take(inbox, frame.length);
      } else if (frame[0] === 3) {
        const flags = view.getUint32(frame.length - 4, true);
        ear.sound_follow(view.getFloat64(8, true), view.getFloat32(80, true), flags & 2, 0);
      }
    }
  };
  const render = () => {
    const at = ear.sound_render(800);
    const samples = new Float32Array(ear.memory.buffer, at, 1600);
    for (let n = 0; n < 800; ++n) heard.push(samples[2 * n]);
  };
  follow(mill.tick(0, 1));
  mill.x.mill_play(1);
  for (let n = 0; n < 240; ++n) {
    follow(mill.tick(1 / 60, 0xffffffff));
    render();
  }
  mill.x.mill_play(0);
  for (let n = 0; n < 60; ++n) {
    follow(mill.tick(1 / 60, 0xffffffff));
    render();
  }
  return heard;
}

test("a slot sounds at the frequency of its teeth, and stops where it is paused", async () => {
  const RATE = 48000, alone = await slotHeard(true), second = alone.slice(3 * RATE, 4 * RATE);
  const line = tone(second, 200, RATE);
  assert.ok(line > 0.01, `the line of the teeth has ${line}`);
  for (const hz of [100, 150, 250, 300, 350]) assert.ok(tone(second, hz, RATE) < 0.02 * line, `${hz} Hz`);
  // By default there is a machine around it, whose noise is louder than its teeth.
  const usual = await slotHeard(false), rms = (x) => Math.hypot(...x) / Math.sqrt(x.length);
  const loud = rms(usual.slice(3 * RATE, 4 * RATE));
  assert.ok(loud > 0.03 && loud < 0.3, `with a machine it is ${loud} of full scale`);
  assert.ok(tone(usual.slice(3 * RATE, 4 * RATE), 200, RATE) > 1e-3);
  for (const heard of [alone, usual]) assert.equal(Math.max(...heard.slice(-24000).map(Math.abs)), 0);
});

test("what is pressed into the part is pushed back", async () => {
  const mill = new Mill(await load("tribo"));
  mill.file("s.nc", new TextEncoder().encode("G21 G90 S6000 F600\nG0 X-10 Y0 Z5\nG1 Z-2\nG1 X60\n"));
  assert.ok(mill.open("s.nc", 0.5), mill.said());
  let felt;
  const tick = () => {
    for (const frame of mill.tick(1 / 60, 100)) if (frame[0] === 7) felt = new DataView(frame.buffer);
  };
  mill.x.mill_finger(30, 0, 1, 1);
  for (let n = 0; n < 30; ++n) tick();
  assert.equal(felt.getUint32(56, true) & 1, 0, "above the part there is no contact");
  mill.x.mill_finger(30, 0, -1, 1);
  for (let n = 0; n < 60; ++n) tick();
  assert.equal(felt.getUint32(56, true) & 1, 1);
  const force = felt.getFloat32(48, true), probe = felt.getFloat32(24, true);
  assert.ok(force > 0.1, `it pushes up with ${force} N`);
  assert.ok(probe > -1, `the finger is held at ${probe} mm, above where the hand wants it`);
  mill.x.mill_feel(0.01, 0.5, 1, 1, 1);
  for (let n = 0; n < 10; ++n) tick();
  assert.equal(felt.getFloat32(48, true), 0, "stopped, no force");
});

test("wrong files are refused with their place", async () => {
  const mill = new Mill(await load("tribo"));
  const refused = (name, text, what) => {
    mill.file(name, new TextEncoder().encode(text));
    assert.equal(mill.open(name), false);
    assert.match(mill.said(), what);
  };
  refused("empty.toml", "", /^empty\.toml:1:1: error: the job is empty/);
  refused("a.toml", "[stok]\n", /^a\.toml:1:2: error: unknown key 'stok'.*\[?stock/);
  refused("a.nc", "G1 X[\n", /^a\.nc:1:/);
  refused("a.csv", "x,y,z,i,j,k\n1,2,3\n", /^a\.csv:2:/);
  refused("a.bin", "\0\0\0", /no job and no program/);
  refused("a.apt", "GOTO/1,2\n", /^a\.apt:1:/);
});

// SPDX-License-Identifier: MIT
// Draws what cuts sound like, as pictures: node scripts/draw_sounds.mjs [--out F.svg] [NAME=REAL.wav ...]
// A panel for each sound, level by time and frequency, and under them third octaves. Made: one cut in steel by force alone, through
// a machining centre and through a router. Beside them any recordings that are named (WAV, 16 or 24 bits or 32-bit numbers). Needs
// build/release/tribo (or TRIBO_PROGRAM). Without arguments it writes docs/sound/cuts.svg.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { crc32, deflateSync } from "node:zlib";

const root = new URL("..", import.meta.url).pathname;
const tribo = process.env.TRIBO_PROGRAM ?? join(root, "build/release/tribo");
let out = join(root, "docs/sound/cuts.svg");
const recordings = [];
for (let args = process.argv.slice(2); args.length > 0; ) {
  const arg = args.shift();
  if (arg === "--out") out = resolve(args.shift() ?? out);
  else {
    const [name, file] = arg.split("=");
    if (file === undefined) throw new Error(`'${arg}' is not NAME=FILE.wav`);
    recordings.push({ name, ...wave(file) });
  }
}

/** The left channel of a WAV file and its rate. */
function wave(file) {
  const bytes = readFileSync(file);
  if (bytes.toString("latin1", 0, 4) !== "RIFF") throw new Error(`${file}: not a WAV file; convert it to one`);
  let format, data;
  for (let at = 12; at + 8 <= bytes.length; at += 8 + bytes.readUInt32LE(at + 4) + (bytes.readUInt32LE(at + 4) % 2)) {
    const chunk = bytes.subarray(at + 8, at + 8 + bytes.readUInt32LE(at + 4));
    if (bytes.toString("latin1", at, at + 4) === "fmt ") format = chunk;
    if (bytes.toString("latin1", at, at + 4) === "data") data = chunk;
  }
  const channels = format.readUInt16LE(2), rate = format.readUInt32LE(4), size = format.readUInt16LE(14) / 8;
  const read = { 2: (at) => data.readInt16LE(at) / 32768, 3: (at) => data.readIntLE(at, 3) / 8388608, 4: (at) => data.readFloatLE(at) }[size];
  if (read === undefined) throw new Error(`${file}: ${8 * size} bits are not read; convert it to 16`);
  return { rate, x: Float64Array.from({ length: Math.floor(data.length / size / channels) }, (_, n) => read(n * size * channels)) };
}

/** One cut of the notes' test: D12.7, five flutes, 4500 rpm, 1270 mm/min, 25.4 mm deep, 1.27 mm wide, in steel. */
function made(name, sound) {
  const work = mkdtempSync(join(tmpdir(), "tribo-sounds-"));
  writeFileSync(join(work, "cut.nc"), "G21 G90 M3 S4500\nG0 X-10 Y-5.08 Z5\nZ-25.4\nG1 X70 F1270\nG0 Z5\nM30\n");
  writeFileSync(join(work, "job.toml"), `[stock]\nbox_mm = [[0, 0, -26], [60, 40, 0]]
[cutter]\nkind = "flat"\ndiameter_mm = 12.7\nflutes = 5\nlength_mm = 60
[material]\nname = "steel"\n[path]\ngcode = "cut.nc"\n[sound]\nmode = "pan"\nbits = 32\n${sound}\n`);
  execFileSync(tribo, ["render", "job.toml", "--out", "out", "--only", "sound", "--resolution", "0.5"], { cwd: work, stdio: "ignore" });
  const heard = { name, ...wave(join(work, "out/sound.wav")) };
  rmSync(work, { recursive: true });
  return heard;
}

/** Power of one windowed frame, bins 0 ... size / 2. */
function power(x, at, size) {
  const re = new Float64Array(size), im = new Float64Array(size);
  for (let n = 0; n < size; ++n) re[n] = (0.5 - 0.5 * Math.cos((2 * Math.PI * (n + 0.5)) / size)) * (x[at + n] ?? 0);
  for (let i = 1, j = 0; i < size; ++i) {
    let bit = size >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) [re[i], re[j]] = [re[j], re[i]];
  }
  for (let half = 1; half < size; half *= 2) {
    for (let k = 0; k < half; ++k) {
      const c = Math.cos((Math.PI * k) / half), s = -Math.sin((Math.PI * k) / half);
      for (let a = k; a < size; a += 2 * half) {
        const b = a + half, r = c * re[b] - s * im[b], i = c * im[b] + s * re[b];
        [re[b], im[b]] = [re[a] - r, im[a] - i];
        re[a] += r;
        im[a] += i;
      }
    }
  }
  return Float64Array.from({ length: size / 2 + 1 }, (_, k) => re[k] * re[k] + im[k] * im[k]);
}

const kLowest = 60, kHighest = 16000, kWidth = 220, kHeight = 260, kSeconds = 3, kRangeDb = 70;
const place = (hz) => Math.log(hz / kLowest) / Math.log(kHighest / kLowest);

/** A picture of the first seconds, as a PNG: time to the right, octaves upwards, 70 dB from dark to bright. */
function spectrogram({ x, rate }) {
  const size = 4096, levels = [];
  let top = -Infinity;
  for (let column = 0; column < kWidth; ++column) {
    const p = power(x, Math.floor((column / kWidth) * kSeconds * rate - size / 2), size);
    for (let row = 0; row < kHeight; ++row) {
      const hz = kLowest * (kHighest / kLowest) ** (1 - (row + 0.5) / kHeight), width = (hz * Math.log(kHighest / kLowest)) / kHeight;
      const first = Math.floor(((hz - width / 2) / rate) * size), last = Math.max(first, Math.floor(((hz + width / 2) / rate) * size));
      let sum = 0;
      for (let k = first; k <= last; ++k) sum += (p[k] ?? 0) * (hz / 1000) / (last - first + 1);
      levels.push(10 * Math.log10(sum + 1e-30));
      top = Math.max(top, levels.at(-1));
    }
  }
  const rows = Buffer.alloc(kHeight * (1 + 3 * kWidth));
  for (let row = 0; row < kHeight; ++row) {
    for (let column = 0; column < kWidth; ++column) {
      const t = Math.max(0, 1 + (levels[column * kHeight + row] - top) / kRangeDb), at = row * (1 + 3 * kWidth) + 1 + 3 * column;
      rows[at] = 255 * Math.min(1, 1.7 * t * t);
      rows[at + 1] = 255 * Math.min(1, t ** 3 + 0.15 * t);
      rows[at + 2] = 255 * Math.min(1, 0.9 * t * (1 - t) + t ** 6);
    }
  }
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type, "latin1"), data]), whole = Buffer.alloc(8 + body.length);
    whole.writeUInt32BE(data.length);
    body.copy(whole, 4);
    whole.writeUInt32BE(crc32(body), 4 + body.length);
    return whole;
  };
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0]);
  header.writeUInt32BE(kWidth);
  header.writeUInt32BE(kHeight, 4);
  return Buffer.concat([Buffer.from("89504e470d0a1a0a", "hex"), chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))]);
}

const kBands = [80, 100, 125, 160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000, 2500, 3150, 4000, 5000, 6300];
/** Third octaves from `from` s on, dB against their sum. */
function bands({ x, rate }, from = 0) {
  const size = 16384, sums = kBands.map(() => 0);
  for (let at = Math.floor(from * rate); at + size <= Math.min(x.length, (from + 3) * rate); at += size / 2) {
    power(x, at, size).forEach((p, k) => {
      const band = Math.floor(10 * Math.log10((k * rate) / size / 1000) + 11.5);
      if (band >= 0 && band < sums.length) sums[band] += p;
    });
  }
  const all = sums.reduce((a, b) => a + b, 0);
  return sums.map((p) => 10 * Math.log10(p / all));
}

// Measured in a shop: the mean of three up cuts of these conditions in steel 4140 (docs/sound.md).
const kReal = [-16, -20, -19, -16, -18, -15, -13, -6, -14, -18, -12, -17, -12, -10, -15, -12, -15, -15, -14, -18];
const sounds = [...recordings, made("force alone", 'machine = "none"'), made("mill, workshop", ""), made("router", 'machine = "router"')];
const hues = ["#1b6ca8", "#e08e1b", "#2a9d8f", "#c8443a", "#7a4fa3", "#8a9a1b"];
const gap = 56, left = 60, wide = left + sounds.length * (kWidth + gap);
const panels = sounds.map((sound, i) => {
  const x = left + i * (kWidth + gap);
  const ticks = [100, 1000, 10000].map((hz) => `<text x="${x - 6}" y="${40 + kHeight * (1 - place(hz)) + 4}" text-anchor="end">${hz < 1000 ? hz : `${hz / 1000}k`}</text>`);
  return `<text x="${x}" y="28" font-weight="bold">${sound.name}</text>${ticks.join("")}<image x="${x}" y="40" width="${kWidth}" height="${kHeight}" href="data:image/png;base64,${spectrogram(sound).toString("base64")}"/>` +
    `<text x="${x}" y="${56 + kHeight}">0</text><text x="${x + kWidth}" y="${56 + kHeight}" text-anchor="end">${kSeconds} s</text>`;
});
const chart = { top: 90 + kHeight, height: 220, width: wide - left - gap };
const xOf = (n) => left + (chart.width * n) / (kBands.length - 1), yOf = (db) => chart.top + (chart.height * Math.min(60, -db)) / 60;
const line = (levels, hue, dash = "") => `<polyline fill="none" stroke="${hue}" stroke-width="2" ${dash} points="${levels.map((db, n) => `${xOf(n).toFixed(1)},${yOf(db).toFixed(1)}`).join(" ")}"/>`;
const grid = [0, -20, -40, -60].map((db) => `<path d="M${left} ${yOf(db)}h${chart.width}" stroke="#ddd"/><text x="${left - 6}" y="${yOf(db) + 4}" text-anchor="end">${db}</text>`);
const names = kBands.map((hz, n) => (n % 3 === 0 ? `<text x="${xOf(n)}" y="${chart.top + chart.height + 18}" text-anchor="middle">${hz}</text>` : ""));
const curves = sounds.map((sound, i) => line(bands(sound, recordings.includes(sound) ? 0 : 0.8), hues[i % hues.length]));
const legend = [...sounds.map((s, i) => [s.name, hues[i % hues.length]]), ["measured in a shop", "#222"]]
  .map(([name, hue], i) => `<text x="${left + 10 + 150 * i}" y="${chart.top + chart.height + 42}" fill="${hue}">${name}</text>`);
writeFileSync(out, `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${wide} ${chart.top + chart.height + 56}" font-family="sans-serif" font-size="12">` +
  `<rect width="100%" height="100%" fill="#fff"/>${panels.join("")}<text x="${left}" y="${chart.top - 14}">third octaves, dB against their sum, by Hz</text>` +
  `${grid.join("")}${names.join("")}${curves.join("")}${line(kReal, "#222", 'stroke-dasharray="6 4"')}${legend.join("")}</svg>\n`);
console.log(out);

// SPDX-License-Identifier: MIT
// Synthetic recordings and images of four materials: node make_materials.mjs DIR
// Each sound is a fingertip drawn over a random surface profile at a steady speed: the profile is made in millimetres of
// way, blurred by the contact patch, differentiated by the motion, and rings the modes of material and finger. Friction
// power F v sets the hiss of the finest asperities (van den Doel, Kry, Pai 2001). Nothing here is recorded.
import { mkdirSync, writeFileSync } from "node:fs";
import { deflateSync } from "node:zlib";
import { materials } from "./surfaces.mjs";
import { images } from "./images.mjs";

const rate = 44100;
const seconds = 8;
const speeds = [40, 120, 360];  // mm/s: slow, medium, fast

function wav(samples) {
  const bytes = Buffer.alloc(44 + 2 * samples.length);
  bytes.write("RIFF", 0);
  bytes.writeUInt32LE(36 + 2 * samples.length, 4);
  bytes.write("WAVEfmt ", 8);
  bytes.writeUInt32LE(16, 16);
  bytes.writeUInt16LE(1, 20);
  bytes.writeUInt16LE(1, 22);
  bytes.writeUInt32LE(rate, 24);
  bytes.writeUInt32LE(2 * rate, 28);
  bytes.writeUInt16LE(2, 32);
  bytes.writeUInt16LE(16, 34);
  bytes.write("data", 36);
  bytes.writeUInt32LE(2 * samples.length, 40);
  samples.forEach((v, n) => bytes.writeInt16LE(Math.round(32767 * Math.max(-1, Math.min(1, v))), 44 + 2 * n));
  return bytes;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  let crc = 0xffffffff;
  for (const byte of body) {
    crc ^= byte;
    for (let k = 0; k < 8; k++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(~crc >>> 0, body.length + 4);
  return out;
}

function png(size, pixels) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(size, 0);
  header.writeUInt32BE(size, 4);
  header.set([8, 2, 0, 0, 0], 8);
  const rows = Buffer.alloc(size * (3 * size + 1));
  for (let y = 0; y < size; y++) {
    for (let n = 0; n < 3 * size; n++)
      rows[y * (3 * size + 1) + 1 + n] = Math.round(Math.max(0, Math.min(255, pixels[y * 3 * size + n])));
  }
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
}

const out = process.argv[2];
if (!out) {
  console.error("usage: node make_materials.mjs DIR");
  process.exit(2);
}
mkdirSync(out, { recursive: true });
for (const [name, sound] of Object.entries(materials)) {
  for (const speed of speeds) writeFileSync(`${out}/${name}_${speed}.wav`, wav(sound(speed, rate, seconds)));
  const { size, pixels } = images[name]();
  writeFileSync(`${out}/${name}.png`, png(size, pixels));
}

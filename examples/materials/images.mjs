// SPDX-License-Identifier: MIT
// Pictures of the four surfaces from height fields under one light; they tile without a seam.
import { random } from "./surfaces.mjs";

const size = 512;
const wrap = (n) => ((n % size) + size) % size;
const at = (field, x, y) => field[wrap(y) * size + wrap(x)];

// Smooth periodic noise about 0: a lattice of `cells` numbers a side, led through cubically.
function lattice(noise, cells) {
  const value = Float64Array.from({ length: cells * cells }, () => noise.gauss());
  const field = new Float64Array(size * size), step = size / cells, soft = (t) => t * t * (3 - 2 * t);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      const i = Math.floor(x / step), j = Math.floor(y / step), u = soft(x / step - i), v = soft(y / step - j);
      const corner = (a, b) => value[((j + b) % cells) * cells + ((i + a) % cells)];
      field[y * size + x] = (1 - v) * ((1 - u) * corner(0, 0) + u * corner(1, 0)) + v * ((1 - u) * corner(0, 1) + u * corner(1, 1));
    }
  }
  return field;
}

function sum(...weighted) {
  const field = new Float64Array(size * size);
  for (const [weight, part] of weighted) part.forEach((v, n) => { field[n] += weight * v; });
  return field;
}

// Adds `add(distance in radii)` within a disc.
function stamp(field, x, y, radius, add) {
  const reach = Math.ceil(radius);
  for (let j = -reach; j <= reach; j++) {
    for (let i = -reach; i <= reach; i++) {
      const d = Math.hypot(i, j) / radius;
      if (d < 1) field[wrap(Math.round(y) + j) * size + wrap(Math.round(x) + i)] += add(d);
    }
  }
}

// Light from the upper left; `colour(height)` is the paint, 0 ... 255 each.
function lit(height, relief, colour) {
  const pixels = new Float64Array(3 * size * size);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      const dx = at(height, x + 1, y) - at(height, x - 1, y), dy = at(height, x, y + 1) - at(height, x, y - 1);
      const nx = -relief * dx, ny = -relief * dy, nz = 1 / Math.hypot(nx, ny, 1);
      const light = Math.max(0, (-0.5 * nx - 0.6 * ny + 0.62) * nz) / 0.62;
      const paint = colour(height[y * size + x], x, y);
      for (let c = 0; c < 3; c++) pixels[3 * (y * size + x) + c] = paint[c] * (0.35 + 0.65 * light);
    }
  }
  return { size, pixels };
}

const mixed = (a, b, t) => a.map((v, c) => v + (b[c] - v) * Math.max(0, Math.min(1, t)));

export const images = {
  sponge() {
    const noise = random(101);
    const height = sum([0.25, lattice(noise, 16)], [0.2, lattice(noise, 64)], [0.18, lattice(noise, 170)]);
    for (let n = 0; n < 900; n++) {
      const radius = 3 + 17 * noise.uniform() ** 4;
      stamp(height, size * noise.uniform(), size * noise.uniform(), radius,
        (d) => -2.2 * Math.sqrt(radius / 10) * (1 - d ** 4));
    }
    return lit(height, 0.55, (h) => mixed([248, 214, 104], [116, 78, 22], -0.33 * h));
  },
  paper() {
    const noise = random(202);
    const height = sum([0.3, lattice(noise, 24)], [0.35, lattice(noise, 90)], [0.5, lattice(noise, 256)]);
    for (let n = 0; n < 2600; n++) {
      let x = size * noise.uniform(), y = size * noise.uniform(), turn = 2 * Math.PI * noise.uniform();
      const rise = 0.5 * noise.gauss(), length = 14 + 36 * noise.uniform(), bend = 0.05 * noise.gauss();
      for (let k = 0; k < length; k++) {
        height[wrap(Math.round(y)) * size + wrap(Math.round(x))] += rise;
        x += Math.cos(turn);
        y += Math.sin(turn);
        turn += bend;
      }
    }
    return lit(height, 0.16, (h) => mixed([238, 235, 226], [252, 251, 247], 0.5 + 0.2 * h));
  },
  towel() {
    const noise = random(303);
    const height = sum([0.25, lattice(noise, 40)], [0.3, lattice(noise, 128)], [0.4, lattice(noise, 256)]);
    const pitch = 64;
    for (let row = 0; row < size / pitch * 2; row++) {
      for (let column = 0; column < size / pitch; column++) {
        stamp(height, (column + (row % 2) / 2) * pitch, row * pitch / 2, 0.46 * pitch,
          (d) => 5 * Math.cos(0.5 * Math.PI * d) ** 2 - (d > 0.86 ? 0.8 : 0));
      }
    }
    return lit(height, 0.3, (h) => mixed([214, 222, 228], [250, 251, 252], 0.35 + 0.13 * h));
  },
  carpet() {
    const noise = random(404);
    const height = new Float64Array(size * size), tint = lattice(noise, 12), pitch = 12.8;
    const shade = new Float64Array(size * size);
    for (let row = 0; row < Math.round(size / pitch); row++) {
      for (let column = 0; column < Math.round(size / pitch); column++) {
        const x = (column + 0.5 * (row % 2)) * pitch + 2.2 * noise.gauss(), y = row * pitch + 2.2 * noise.gauss();
        const tone = noise.gauss(), turn = 0.9 + 0.35 * noise.gauss();
        // A loop: a short arched ridge of twisted yarn.
        for (let k = -6; k <= 6; k++) {
          const px = x + k * Math.cos(turn), py = y + k * Math.sin(turn), arch = 1 - (k / 7) ** 2;
          stamp(height, px, py, 6, (d) => 0.7 * arch * (1 - d * d) * (1 + 0.25 * Math.sin(1.8 * k + 3 * d)));
          stamp(shade, px, py, 5, () => 0.015 * tone);
        }
      }
    }
    return lit(height, 0.24, (h, x, y) => {
      const n = y * size + x;
      return mixed([104, 30, 40], [222, 92, 84], 0.1 * h + 0.12 * tint[n] + shade[n]);
    });
  },
};

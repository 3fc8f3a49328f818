// SPDX-License-Identifier: MIT
// What a fingertip hears of four surfaces: sound(speed in mm/s, rate in Hz, seconds) -> samples, full scale 1.

// Numbers that are the same on every run (mulberry32).
export function random(seed) {
  let state = seed >>> 0;
  const uniform = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  const gauss = () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
  return { uniform, gauss };
}

// A mode that rings: unit response at its peak.
function mode(hz, decay_s, gain, rate) {
  const r = Math.exp(-1 / (decay_s * rate)), b = 2 * r * Math.cos((2 * Math.PI * hz) / rate);
  const scale = gain * (1 - r) * Math.sqrt(1 - 2 * r * Math.cos((4 * Math.PI * hz) / rate) + r * r);
  let y1 = 0, y2 = 0;
  return (x) => {
    const y = scale * x + b * y1 - r * r * y2;
    y2 = y1;
    y1 = y;
    return y;
  };
}

// First-order low-pass.
function blur(hz, rate) {
  const k = 1 - Math.exp((-2 * Math.PI * hz) / rate);
  let y = 0;
  return (x) => (y += k * (x - y));
}

// `drive(x_mm, dx_mm, noise)` is the force at a place; fine asperities hiss beneath it.
function rubbed({ seed, modes, hiss, patch_mm, level, drive }) {
  return (speed, rate, seconds) => {
    const noise = random(seed + speed), rings = modes.map(([hz, s, gain]) => mode(hz, s, gain, rate));
    // The contact patch passes over a place within patch / speed: what is finer is blurred.
    const patch = blur(Math.min(speed / patch_mm, 0.45 * rate), rate);
    const force = drive(random(seed));
    const samples = new Float64Array(seconds * rate);
    const dx = speed / rate, hiss_now = hiss * Math.sqrt(speed / 100);
    let x = 0;
    for (let n = 0; n < samples.length; n++) {
      x += dx;
      const push = patch(force(x, dx, noise)) + hiss_now * noise.gauss();
      let y = 0.05 * push;
      for (const ring of rings) y += ring(push);
      samples[n] = level * y;
    }
    return samples;
  };
}

// Places along the way, `per_mm` of them on average, `scatter` 0: even, 1: at random.
function places(noise, per_mm, scatter, hit) {
  let next = noise.uniform() / per_mm;
  return (x) => {
    let sum = 0;
    while (x >= next) {
      sum += hit(noise);
      next += ((1 - scatter) - scatter * Math.log(1 - noise.uniform())) / per_mm;
    }
    return sum;
  };
}

// A burst of noise after each place, as a tuft springs back.
function bursts(noise, per_mm, scatter, length_mm, size) {
  let level = 0;
  const hit = places(noise, per_mm, scatter, size);
  return (x, dx, fresh) => {
    level = level * Math.exp(-dx / length_mm) + hit(x);
    return level * fresh.gauss();
  };
}

export const materials = {
  // Open pores: the skin snaps over their rims, large ones louder; the foam rings low and damped.
  sponge: rubbed({
    seed: 11, modes: [[420, 0.003, 3], [950, 0.0018, 2.5], [2300, 0.0008, 1.5]], hiss: 0.05, patch_mm: 0.05, level: 0.16,
    drive: (noise) => {
      const rims = places(noise, 0.35, 0.8, (r) => (r.uniform() < 0.35 ? -1 : 1) * (2 + 10 * r.uniform() ** 2));
      return (x, dx) => rims(x) * Math.sqrt(dx / 0.003);
    },
  }),
  // Calendered fibres: fine, dense, bright.
  paper: rubbed({
    seed: 22, modes: [[1300, 0.0006, 1.5], [3600, 0.0005, 2], [7200, 0.0003, 1.6]], hiss: 0.6, patch_mm: 0.02, level: 0.05,
    drive: () => (x, dx, fresh) => fresh.gauss() * Math.sqrt(dx / 0.003),
  }),
  // Soft fibres on embossed cushions: louder on their tops, nearly silent between.
  towel: rubbed({
    seed: 33, modes: [[700, 0.001, 1.6], [1900, 0.0007, 1.5], [4200, 0.0004, 0.8]], hiss: 0.12, patch_mm: 0.04, level: 0.11,
    drive: () => (x, dx, fresh) => {
      const top = Math.max(0, Math.sin((2 * Math.PI * x) / 5));
      return fresh.gauss() * (0.15 + 1.4 * top * top) * Math.sqrt(dx / 0.003);
    },
  }),
  // Loops of yarn that bend and spring back, row after row.
  carpet: rubbed({
    seed: 44, modes: [[260, 0.004, 2.2], [780, 0.002, 2], [1700, 0.001, 1.2], [3900, 0.0005, 0.5]], hiss: 0.06,
    patch_mm: 0.06, level: 0.2,
    drive: (noise) => {
      const tufts = bursts(noise, 0.4, 0.25, 0.25, (r) => 0.6 + 2.5 * r.uniform() ** 2);
      return (x, dx, fresh) => tufts(x, dx, fresh) * Math.sqrt(dx / 0.003);
    },
  }),
};

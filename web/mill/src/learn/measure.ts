// SPDX-License-Identifier: MIT
// What an ear may go by, measured in the samples of a steady cut.

/** Levels in dB under full scale. */
export interface Heard {
  level_db: number; // of all
  teeth_db: number; // of the tones of the teeth: multiples of their rate
  turn_db: number; // of the other multiples of the spindle's rate
  tone_db: number; // of the strongest tone beside these
  tone_hz: number;
  hiss_db: number; // of all above HISS_HZ
}

const HISS_HZ = 5000;
// Tones are sought up to here, and a tone beside others from here on; noise is below.
const HIGHEST_TONE_HZ = 5000;
const LOWEST_TONE_HZ = 400;
const BLOCK = 16384;
// A tone fills so many bins on each side, the noise beside it is taken from the next ones.
const TONE_BINS = 3;
const NOISE_BINS = 12;
// What is as close to a multiple of the spindle's rate is part of it.
const APART_BINS = 6;
const SILENCE = 1e-12;

// Fast Fourier transform in place (Cooley and Tukey 1965); the length is a power of two.
function transform(re: Float64Array, im: Float64Array): void {
  const n = re.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i >= j) continue;
    [re[i], re[j]] = [re[j]!, re[i]!];
    [im[i], im[j]] = [im[j]!, im[i]!];
  }
  for (let length = 2; length <= n; length *= 2) {
    const half = length / 2;
    for (let k = 0; k < half; ++k) {
      const angle = (-2 * Math.PI * k) / length;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let i = k; i < n; i += length) {
        const j = i + half;
        const [x, y] = [re[j]! * c - im[j]! * s, re[j]! * s + im[j]! * c];
        [re[j], im[j]] = [re[i]! - x, im[i]! - y];
        [re[i], im[i]] = [re[i]! + x, im[i]! + y];
      }
    }
  }
}

/** Mean square in each bin: of blocks with a Hann window that overlap by half (Welch 1967). */
export function powersOf(samples: Float32Array): Float64Array {
  const out = new Float64Array(BLOCK / 2);
  const window = Float64Array.from({ length: BLOCK }, (_, n) => 0.5 - 0.5 * Math.cos((2 * Math.PI * n) / BLOCK));
  let blocks = 0;
  for (let first = 0; first + BLOCK <= samples.length; first += BLOCK / 2) {
    const re = window.map((w, n) => w * samples[first + n]!);
    const im = new Float64Array(BLOCK);
    transform(re, im);
    // By Parseval: the window has a mean square of 3/8, and half of the power is at negative frequencies.
    for (let k = 1; k < out.length; ++k) out[k]! += (2 * (re[k]! ** 2 + im[k]! ** 2)) / (0.375 * BLOCK ** 2);
    ++blocks;
  }
  return out.map((power) => power / Math.max(blocks, 1));
}

const decibel = (power: number) => 10 * Math.log10(Math.max(power, SILENCE));

/** Of at least BLOCK samples. */
export function hear(samples: Float32Array, rate: number, spindleHz: number, flutes: number): Heard {
  const powers = powersOf(samples);
  const bin = rate / BLOCK;
  const sum = (first: number, last: number) => {
    let all = 0;
    for (let k = Math.max(first, 0); k <= last && k < powers.length; ++k) all += powers[k]!;
    return all;
  };
  // Without the noise below it.
  const toneAt = (hz: number) => {
    const k = Math.round(hz / bin);
    const wide = 2 * TONE_BINS + 1;
    const tone = sum(k - TONE_BINS, k + TONE_BINS);
    const around = sum(k - TONE_BINS - NOISE_BINS, k + TONE_BINS + NOISE_BINS) - tone;
    return Math.max(0, tone - (wide * around) / (2 * NOISE_BINS));
  };
  let [teeth, turn, tone, toneHz] = [0, 0, 0, 0];
  for (let order = 1; order * spindleHz < HIGHEST_TONE_HZ; ++order) {
    const power = toneAt(order * spindleHz);
    if (order % flutes === 0) teeth += power;
    else turn += power;
  }
  for (let hz = LOWEST_TONE_HZ; hz < HIGHEST_TONE_HZ; hz += bin) {
    const off = hz % spindleHz;
    if (Math.min(off, spindleHz - off) < APART_BINS * bin) continue;
    const power = toneAt(hz);
    if (power > tone) [tone, toneHz] = [power, hz];
  }
  return {
    level_db: decibel(sum(1, powers.length)),
    teeth_db: decibel(teeth),
    turn_db: decibel(turn),
    tone_db: decibel(tone),
    tone_hz: toneHz,
    hiss_db: decibel(sum(Math.ceil(HISS_HZ / bin), powers.length)),
  };
}

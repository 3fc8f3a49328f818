// SPDX-License-Identifier: MIT
// The largest value of a quantity over the time of a program, in bins that are drawn as columns at any width.

const BINS = 4096;

export class Bins {
  private readonly most = new Float32Array(BINS).fill(Number.NaN);
  private duration = 1;
  largest = 0;

  begin(duration: number): void {
    this.duration = Math.max(duration, 1e-9);
    this.clear();
  }
  clear(): void {
    this.most.fill(Number.NaN);
    this.largest = 0;
  }

  // A value from `time` on, s. Zeros and NaN are no values.
  add(time: number, duration: number, value: number): void {
    if (!(value > 0) || time + duration < 0) return;
    const scale = BINS / this.duration;
    const from = Math.max(Math.floor(time * scale), 0);
    const to = Math.min(Math.max(Math.ceil((time + duration) * scale), from + 1), BINS);
    for (let n = from; n < to; ++n) if (!(this.most[n]! >= value)) this.most[n] = value;
    this.largest = Math.max(this.largest, value);
  }

  /** The largest value of each of `width` columns; NaN: none. */
  columns(width: number): Float32Array {
    const out = new Float32Array(width).fill(Number.NaN);
    const bin = (x: number) => Math.floor((x * BINS) / width);
    for (let x = 0; x < width; ++x) {
      const to = Math.max(bin(x + 1), bin(x) + 1);
      for (let n = bin(x); n < to; ++n) if (this.most[n]! > (out[x]! || 0)) out[x] = this.most[n]!;
    }
    return out;
  }

  at(time: number): number {
    return this.most[Math.floor((time / this.duration) * BINS)] ?? Number.NaN;
  }
}

/** The next larger round number, for the end of an axis. */
export function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const decade = 10 ** Math.floor(Math.log10(value));
  return (
    decade * ([1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((times) => times * decade >= value * (1 - 1e-9)) ?? 10)
  );
}

/** Times of the marks on an axis of `duration` seconds with about `ways` parts. */
export function timeMarks(duration: number, ways: number): number[] {
  const steps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 36000];
  const step = steps.find((s) => duration / s <= ways) ?? roundUp(duration / ways);
  return Array.from({ length: Math.floor(duration / step + 1e-9) + 1 }, (_, n) => n * step);
}

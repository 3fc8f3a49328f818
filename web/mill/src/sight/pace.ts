// SPDX-License-Identifier: MIT
// Watches how long pictures take from where they are asked for, and says once when that is too long.

// So many pictures tell, or fewer that take so long together, ms: where each takes seconds nobody waits for many.
const ENOUGH = 24;
const FEW = 6;
const TOO_LONG_MS = 2000;
const SLOW_MS = 45;

export class Pace {
  private readonly times: number[] = [];
  private from = -Infinity;
  private said = false;

  constructor(private readonly slow: () => void) {}

  // A picture is asked for at this time, ms.
  asked(now: number): void {
    this.from = now;
  }

  // It was drawn. The next one may follow it at once.
  drawn(now: number): void {
    const time = now - this.from;
    this.from = now;
    if (this.said || !Number.isFinite(time)) return;
    this.times.push(time);
    const sum = this.times.reduce((all, one) => all + one, 0);
    if (this.times.length < (sum < TOO_LONG_MS ? ENOUGH : FEW)) return;
    const middle = this.times.sort((a, b) => a - b)[this.times.length >> 1]!;
    this.times.length = 0;
    if (middle <= SLOW_MS) return;
    this.said = true;
    this.slow();
  }

  // Measures anew, after the user has chosen.
  begin(): void {
    this.times.length = 0;
    this.said = false;
  }
}

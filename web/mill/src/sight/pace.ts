// SPDX-License-Identifier: MIT
// Watches how long pictures take while they follow each other, and says once when that is too long.

const ENOUGH = 24;
// Two pictures further apart than this do not follow each other, ms.
const APART_MS = 500;
const SLOW_MS = 45;

export class Pace {
  private readonly gaps: number[] = [];
  private before = -Infinity;
  private said = false;

  constructor(private readonly slow: () => void) {}

  // A picture was drawn at this time, ms.
  drawn(now: number): void {
    const gap = now - this.before;
    this.before = now;
    if (this.said || gap > APART_MS) return;
    this.gaps.push(gap);
    if (this.gaps.length < ENOUGH) return;
    const middle = this.gaps.sort((a, b) => a - b)[ENOUGH / 2]!;
    this.gaps.length = 0;
    if (middle <= SLOW_MS) return;
    this.said = true;
    this.slow();
  }

  // Measures anew, after the user has chosen.
  begin(): void {
    this.gaps.length = 0;
    this.said = false;
  }
}

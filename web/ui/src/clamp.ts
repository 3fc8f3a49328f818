// SPDX-License-Identifier: MIT
// A number kept within bounds.

export const clamp = (v: number, low: number, high: number) => Math.min(Math.max(v, low), high);

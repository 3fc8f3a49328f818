// SPDX-License-Identifier: MIT
// What the page says of time, and what it remembers.

export function clock(seconds: number): string {
  const s = Math.floor(seconds);
  return `${Math.floor(s / 60)}:${String(s % 60).padStart(2, "0")}`;
}

// Remembered between visits, where the browser lets a page remember.
export function recall(key: string): string {
  try {
    return localStorage.getItem(`tribo.${key}`) ?? "";
  } catch {
    return "";
  }
}
export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(`tribo.${key}`, value);
  } catch {
    // A page without a memory forgets.
  }
}

// SPDX-License-Identifier: MIT
// Small things that every part of the page asks for.

export function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

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

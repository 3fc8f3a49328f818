// SPDX-License-Identifier: MIT
// The clock text of the page, and its stored settings.

export function clock(seconds: number): string {
  const s = Math.floor(seconds);
  return `${Math.floor(s / 60)}:${String(s % 60).padStart(2, "0")}`;
}

// Settings kept between visits, if the browser allows storage.
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
    // Without storage the value is lost.
  }
}

// SPDX-License-Identifier: MIT
// The clock text of the page, its theme, and its stored settings.

export function clock(seconds: number): string {
  const s = Math.floor(seconds);
  return `${Math.floor(s / 60)}:${String(s % 60).padStart(2, "0")}`;
}

// What is drawn by hand is drawn anew when this changes.
export function theme(): string {
  return `${document.documentElement.dataset.theme} ${matchMedia("(prefers-color-scheme: dark)").matches}`;
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

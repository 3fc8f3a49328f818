// SPDX-License-Identifier: MIT
// Small helpers for all pages.

export function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

/** The text of an error, for users. */
export function wordsOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

// A browser may still read from the address after the click.
const ADDRESS_LASTS_MS = 60_000;

/** Offers a file for download. */
export function download(content: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), ADDRESS_LASTS_MS);
}

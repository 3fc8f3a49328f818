// SPDX-License-Identifier: MIT

/** Gives a canvas the pixels of the screen under it. Returns how many a CSS pixel is wide: the screen's ratio, at most `most`. */
export function fitToScreen(canvas: HTMLCanvasElement, most = Infinity): number {
  const ratio = Math.min(devicePixelRatio || 1, most);
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  // To set a size clears the canvas even where it is the same.
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  return ratio;
}

// SPDX-License-Identifier: MIT

/**
 * Fits the pixels of a canvas to the screen. Returns the pixels per CSS pixel: the ratio of the screen, at most
 * `most`.
 */
export function fitToScreen(canvas: HTMLCanvasElement, most = Infinity): number {
  const ratio = Math.min(devicePixelRatio || 1, most);
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  // Setting the size clears the canvas even if it is unchanged.
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  return ratio;
}

// SPDX-License-Identifier: MIT
// Relief estimated from an image: at a large change of brightness the finger meets an edge. There the friction sound
// is louder, so that a visible pattern can be heard.

import { clamp } from "@tribo/ui/clamp";

const kSide = 128;

/** Returns the image at another size. */
export function pixelsOf(image: HTMLImageElement, width: number, height: number): ImageData {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(image, 0, 0, width, height);
  return context.getImageData(0, 0, width, height);
}

/** Returns the brightness of a pixel, 0 to 255. */
export function grey(data: Uint8ClampedArray, pixel: number): number {
  return 0.3 * data[4 * pixel]! + 0.59 * data[4 * pixel + 1]! + 0.11 * data[4 * pixel + 2]!;
}

export class Relief {
  #steepness: Float32Array;
  #width: number;
  #height: number;

  constructor(image: HTMLImageElement) {
    const longer = Math.max(image.naturalWidth, image.naturalHeight);
    this.#width = Math.max(2, Math.round((kSide * image.naturalWidth) / longer));
    this.#height = Math.max(2, Math.round((kSide * image.naturalHeight) / longer));
    const { data } = pixelsOf(image, this.#width, this.#height);
    const bright = (x: number, y: number) =>
      grey(data, Math.min(y, this.#height - 1) * this.#width + Math.min(x, this.#width - 1));
    this.#steepness = new Float32Array(this.#width * this.#height);
    let sum = 0;
    for (let y = 0; y < this.#height; ++y) {
      for (let x = 0; x < this.#width; ++x) {
        const here = bright(x, y);
        const steep = Math.hypot(bright(x + 1, y) - here, bright(x, y + 1) - here);
        this.#steepness[y * this.#width + x] = steep;
        sum += steep;
      }
    }
    const mean = sum / this.#steepness.length;
    for (let i = 0; i < this.#steepness.length; ++i) this.#steepness[i] = mean > 1 ? this.#steepness[i]! / mean : 1;
  }

  /** Factor on the sound level at a position (0 to 1 from the top left): 1 on average, within 6 dB. */
  gain(u: number, v: number): number {
    const x = clamp(Math.floor(u * this.#width), 0, this.#width - 1);
    const y = clamp(Math.floor(v * this.#height), 0, this.#height - 1);
    return clamp(Math.sqrt(this.#steepness[y * this.#width + x]!), 0.5, 2);
  }
}

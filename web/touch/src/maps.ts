// SPDX-License-Identifier: MIT
// Images with the slope of the grain and the stiffness at each position of a material.
import type { Engine, Sheet } from "./engine.js";
import { grey, pixelsOf } from "./relief.js";
import type { Picture } from "./renderer.js";

const kStrongestFactor = 8;

async function fetched(address: string): Promise<HTMLImageElement> {
  const image = new Image();
  image.crossOrigin = "anonymous";
  image.src = address;
  await image.decode();
  return image;
}

/** The small relief of a picture, from the image or, if `address` is not "", from a height map. */
export async function smallRelief(
  { image, nodesX, nodesY }: Picture,
  address: string,
  rmsSlope: number,
  engine: Engine,
): Promise<ImageData> {
  let from = image;
  if (address !== "") {
    from = await fetched(address);
    if (from.naturalWidth !== image.naturalWidth || from.naturalHeight !== image.naturalHeight) {
      throw new Error(
        `${address}: the height map has ${from.naturalWidth} x ${from.naturalHeight} pixels; ` +
          `give one of ${image.naturalWidth} x ${image.naturalHeight}, as the image`,
      );
    }
  }
  const pixels = pixelsOf(from, nodesX, nodesY);
  engine.smallRelief(pixels, rmsSlope);
  return pixels;
}

/** The grey of an image at each node of a sheet: levels of stiffnessPalette. */
export async function stiffnessLevels(address: string, sheet: Sheet): Promise<Uint8Array> {
  const { data } = pixelsOf(await fetched(address), sheet.width, sheet.height);
  return Uint8Array.from({ length: sheet.width * sheet.height }, (_, pixel) => Math.round(grey(data, pixel)));
}

/** K and nu of each grey: white has the stiffness of the material, black eight times as much. */
export function stiffnessPalette(stiffness: number, damping: number): Float64Array {
  return Float64Array.from({ length: 512 }, (_, n) =>
    n % 2 === 0 ? stiffness * kStrongestFactor ** (1 - n / 510) : damping,
  );
}

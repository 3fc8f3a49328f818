// SPDX-License-Identifier: MIT
// The part as a binary glTF 2.0 file, as `tribo render` writes it: positions in mm with z up, a node that converts them
// to the metres of glTF with y up, and no normals, so that viewers shade each triangle flat and cusps stay sharp.

import type { Triangles } from "./triangles.js";

// Constants of the standard (glTF 2.0, 3.6.2, 3.7.2 and 4.4).
const FLOAT = 5126;
const UNSIGNED_INT = 5125;
const ARRAY_BUFFER = 34962;
const ELEMENT_ARRAY_BUFFER = 34963;
const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;
const HEADER = 12;
const CHUNK_HEADER = 8;
// The unit of glTF is the metre.
const UNIT_MM = 1000;

/** Colours as 0xrrggbb. */
export interface GlbColours {
  metal: boolean;
  machined: number;
  untouched: number;
}

// Factors are linear, colours of the screen are not (IEC 61966-2-1).
function linear(colour: number): number[] {
  return [16, 8, 0].map((shift) => {
    const c = ((colour >> shift) & 255) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
}

function material(name: string, colour: number, metal: boolean) {
  return {
    name,
    pbrMetallicRoughness: {
      baseColorFactor: [...linear(colour), 1],
      metallicFactor: metal ? 0.8 : 0.3,
      roughnessFactor: 0.5,
    },
  };
}

/** The vertices of all pieces, and the indices of the machined triangles before those of the untouched. */
function merged(pieces: readonly Triangles[]) {
  const positions = new Float32Array(pieces.reduce((sum, piece) => sum + piece.positions.length, 0));
  const indices = new Uint32Array(pieces.reduce((sum, piece) => sum + piece.indices.length, 0));
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  let first = 0;
  for (const piece of pieces) {
    positions.set(piece.positions, first);
    first += piece.positions.length;
  }
  for (let n = 0; n < positions.length; ++n) {
    min[n % 3] = Math.min(min[n % 3]!, positions[n]!);
    max[n % 3] = Math.max(max[n % 3]!, positions[n]!);
  }
  let at = 0;
  let machined = 0;
  for (const wanted of [false, true]) {
    first = 0;
    for (const { positions: own, indices: corners, onBlank } of pieces) {
      for (let n = 0; n < corners.length; n += 3) {
        const triangle = [corners[n]!, corners[n + 1]!, corners[n + 2]!];
        if (triangle.every((k) => onBlank[k] !== 0) !== wanted) continue;
        for (const k of triangle) indices[at++] = first + k;
      }
      first += own.length / 3;
    }
    if (!wanted) machined = at;
  }
  return { positions, indices, machined, min, max };
}

export function glb(pieces: readonly Triangles[], colours: GlbColours): Blob {
  const { positions, indices, machined, min, max } = merged(pieces);
  const ranges = [
    { material: 0, first: 0, count: machined },
    { material: 1, first: machined, count: indices.length - machined },
  ].filter(({ count }) => count > 0);
  const k = 1 / UNIT_MM;
  const node = { name: "part", matrix: [k, 0, 0, 0, 0, 0, -k, 0, 0, k, 0, 0, 0, 0, 0, 1] };
  const asset = { version: "2.0", generator: "Tribo", extras: { unit_mm: UNIT_MM } };
  const whole = {
    buffers: [{ byteLength: positions.byteLength + indices.byteLength }],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: positions.byteLength, target: ARRAY_BUFFER },
      { buffer: 0, byteOffset: positions.byteLength, byteLength: indices.byteLength, target: ELEMENT_ARRAY_BUFFER },
    ],
    accessors: [
      { bufferView: 0, componentType: FLOAT, count: positions.length / 3, type: "VEC3", min, max },
      ...ranges.map(({ first, count }) => ({
        bufferView: 1,
        byteOffset: 4 * first,
        componentType: UNSIGNED_INT,
        count,
        type: "SCALAR",
      })),
    ],
    materials: [
      material("machined", colours.machined, colours.metal),
      material("stock", colours.untouched, colours.metal),
    ],
    meshes: [
      {
        name: "machined part",
        primitives: ranges.map((range, n) => ({
          attributes: { POSITION: 0 },
          indices: n + 1,
          material: range.material,
        })),
      },
    ],
  };
  // Empty arrays are not allowed: a part that is all gone is a node without a mesh.
  const gone = indices.length === 0;
  const document = {
    asset,
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [gone ? node : { ...node, mesh: 0 }],
    ...(gone ? {} : whole),
  };
  const text = new TextEncoder().encode(JSON.stringify(document));
  const padding = new Uint8Array((4 - (text.length % 4)) % 4).fill(0x20);
  const chunk = (length: number, kind: number) => new Uint32Array([length, kind]);
  const parts: BlobPart[] = [chunk(text.length + padding.length, JSON_CHUNK), text, padding];
  let length = HEADER + CHUNK_HEADER + text.length + padding.length;
  if (!gone) {
    const binary = positions.byteLength + indices.byteLength;
    parts.push(chunk(binary, BINARY_CHUNK), positions, indices);
    length += CHUNK_HEADER + binary;
  }
  return new Blob([new Uint32Array([MAGIC, 2, length]), ...parts], { type: "model/gltf-binary" });
}

// SPDX-License-Identifier: MIT
// The shader of the surface with the constants of the studio (web/ui/src/studio.ts).

import { SAW_MARKS } from "@tribo/ui/saw_marks";
import { MACHINED, MARKS, PAINT, SAWN, SUN } from "@tribo/ui/studio";
import { ROOM_SIDE } from "./part_room.js";
import { kPartFragment } from "./part_shader.js";

// Ends of the colours of a deviation.
const GOUGE = 0xd95e03;
const REST = 0x54389e;

const linear = (srgb: number) => (srgb <= 0.04045 ? srgb / 12.92 : ((srgb + 0.055) / 1.055) ** 2.4);
const glsl = (name: string, value: readonly number[]) => {
  const type = value.length > 1 ? `vec${value.length}` : "float";
  return `const ${type} ${name} = ${type}(${value.map((v) => v.toFixed(4)).join()});`;
};
const colour = (name: string, rgb: number) =>
  glsl(
    name,
    [16, 8, 0].map((shift) => linear(((rgb >> shift) & 255) / 255)),
  );
const finish = (name: string, of: { roughness: number; metalness: number }) => glsl(name, [of.roughness, of.metalness]);

const size = Math.hypot(...SUN.towards);
export const FRAGMENT = [
  "#version 300 es\nprecision highp float;",
  glsl(
    "sun",
    SUN.towards.map((v) => v / size),
  ),
  glsl("strength", [SUN.strength]),
  glsl("side", [ROOM_SIDE]),
  glsl("depth", [MARKS]),
  colour("sunlight", SUN.colour),
  colour("machined", MACHINED.colour),
  colour("sawn", SAWN.colour),
  colour("gouge", GOUGE),
  colour("rest", REST),
  finish("machinedFinish", MACHINED),
  finish("sawnFinish", SAWN),
  finish("paintFinish", PAINT),
  SAW_MARKS,
  kPartFragment,
].join("");

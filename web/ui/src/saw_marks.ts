// SPDX-License-Identifier: MIT

/** Marks of a saw at a place, mm, about -0.5 to 0.5; they fade where they are finer than a pixel. */
export const SAW_MARKS = /* glsl */ `
float noiseOf(float s) {
  float n = floor(s), f = s - n;
  vec2 h = fract(sin(vec2(n, n + 1.0) * 12.9898) * 43758.5453);
  return mix(h.x, h.y, f * f * (3.0 - 2.0 * f)) - 0.5;
}
float sawMarks(vec3 p) {
  float s = dot(p, vec3(0.12, 0.83, 0.55)) + 0.15 * sin(0.21 * p.x);
  float fine = clamp(1.0 - 1.2 * fwidth(s) * 3.0, 0.0, 1.0), broad = clamp(1.0 - 1.2 * fwidth(s) * 0.7, 0.0, 1.0);
  return 0.65 * broad * noiseOf(0.7 * s) + 0.5 * fine * noiseOf(3.0 * s);
}`;

// SPDX-License-Identifier: MIT
// Shaders of the surface of the part, with flat triangles, and of the mark at the tool tip.

export const kPartVertex = `#version 300 es
in vec3 place;
in float untouched;
in float deviation;
uniform mat4 view;
uniform vec3 origin;
uniform vec3 scales;  // step of places, step and range of deviations
out vec3 world;
out float blank;
out float off;
void main() {
  world = origin + scales.x * place;
  blank = untouched;
  off = scales.y * deviation / max(scales.z, 1e-9);
  gl_Position = view * vec4(world, 1.0);
}`;

export const kPartFragment = `#version 300 es
precision highp float;
in vec3 world;
in float blank;
in float off;
uniform vec3 eye;
uniform bool deviations;
out vec4 colour;
void main() {
  vec3 n = normalize(cross(dFdx(world), dFdy(world))), to = normalize(eye - world);
  n = faceforward(n, -to, n);
  vec3 machined = vec3(0.31, 0.53, 0.78), stock = vec3(0.66, 0.68, 0.71);
  if (deviations) {
    float t = clamp(off, -1.0, 1.0);
    vec3 end = t < 0.0 ? vec3(0.85, 0.37, 0.01) : vec3(0.33, 0.22, 0.62);
    machined = mix(vec3(0.96), end, abs(t));
  }
  vec3 base = blank > 0.99 ? stock : machined;
  float lamp = max(dot(n, normalize(to + vec3(-0.3, -0.35, 0.6))), 0.0);
  float sky = 0.5 + 0.5 * n.z;
  colour = vec4(base * (0.34 + 0.2 * sky + 0.58 * lamp) + 0.08 * pow(lamp, 40.0), 1.0);
}`;

export const kMarkVertex = `#version 300 es
uniform mat4 view;
uniform vec3 tip;
uniform float size;
void main() {
  gl_Position = view * vec4(tip, 1.0);
  gl_Position.z -= 1e-3 * gl_Position.w;
  gl_PointSize = size;
}`;

export const kMarkFragment = `#version 300 es
precision mediump float;
out vec4 colour;
void main() {
  float r = 2.0 * length(gl_PointCoord - 0.5);
  if (r > 1.0) discard;
  colour = r > 0.72 ? vec4(0.1, 0.1, 0.1, 1.0) : vec4(0.95, 0.78, 0.0, 1.0);
}`;

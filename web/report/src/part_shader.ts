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

// The studio is reflected after Karis 2014, "Physically based shading on mobile", the sun by GGX (Walter et al. 2007), and
// bright light is compressed by Khronos PBR Neutral (2024), as in src/report/picture/studio.cpp. Constants: part_finish.ts.
export const kPartFragment = `in vec3 world;
in float blank;
in float off;
uniform vec3 eye;
uniform bool deviations;
uniform sampler2D room;
uniform vec2 turn;  // cosine and sine of the studio's turn: it goes round the part with the viewer
out vec4 colour;
vec4 roomAt(vec3 d) {
  d.xy = vec2(turn.x * d.x + turn.y * d.y, turn.x * d.y - turn.y * d.x);
  d /= abs(d.x) + abs(d.y) + abs(d.z);
  vec2 s = d.z < 0.0 ? (1.0 - abs(d.yx)) * mix(vec2(-1.0), vec2(1.0), step(0.0, d.xy)) : d.xy;
  return texture(room, (0.5 * (s + 1.0) * (side - 1.0) + 0.5) / side);
}
vec3 lit(vec3 own, vec2 finish, float mirrored, vec3 n, vec3 to) {
  float roughness = finish.x, metalness = finish.y;
  float facing = clamp(dot(n, to), 1e-3, 1.0), towards = max(dot(n, sun), 0.0);
  float a = min((1.0 - roughness) * (1.0 - roughness), exp2(-9.28 * facing)) * (1.0 - roughness) + 0.0425 - 0.0275 * roughness;
  vec2 share = vec2(-1.04, 1.04) * a + vec2(1.04 - 0.572 * roughness, 0.022 * roughness - 0.04);
  vec3 head = mix(vec3(0.04), own, metalness), h = normalize(to + sun);
  float a2 = pow(roughness, 4.0), nh = dot(n, h), d = nh * nh * (a2 - 1.0) + 1.0;
  float seen = 0.5 / max(towards * sqrt(facing * facing * (1.0 - a2) + a2) + facing * sqrt(towards * towards * (1.0 - a2) + a2), 1e-4);
  float bright = strength * towards, spark = bright * seen * a2 / (3.1416 * d * d);
  float soft = (1.0 - metalness) * (roomAt(n).a + bright / 3.1416);
  return mirrored * (head * share.x + share.y) + own * soft +
    sunlight * spark * (head + pow(1.0 - dot(to, h), 5.0) * (1.0 - head));
}
vec3 toned(vec3 c) {
  float least = min(c.r, min(c.g, c.b));
  c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  float peak = max(c.r, max(c.g, c.b)), start = 0.76, room = 1.0 - start;
  if (peak < start) return c;
  float lower = 1.0 - room * room / (peak + room - start);
  return mix(vec3(lower), c * lower / peak, 1.0 / (0.15 * (peak - lower) + 1.0));
}
void main() {
  vec3 n = normalize(cross(dFdx(world), dFdy(world))), to = normalize(eye - world);
  n = faceforward(n, -to, n);
  vec4 seen = roomAt(reflect(-to, n));
  float marks = sawMarks(world), t = clamp(off, -1.0, 1.0);
  vec3 light;
  if (blank > 0.99) light = lit(sawn * (1.0 + depth * marks), sawnFinish, seen.g, n, to);
  else if (deviations) light = lit(mix(vec3(0.91), t < 0.0 ? gouge : rest, abs(t)), paintFinish, seen.b, n, to);
  else light = lit(machined, machinedFinish, seen.r, n, to);
  light = clamp(toned(light), 0.0, 1.0);
  colour = vec4(mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light)), 1.0);
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

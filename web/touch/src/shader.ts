// SPDX-License-Identifier: MIT
// Renders a pressed image with the equations of src/elastic/picture.cpp, one fragment per pixel. The unit of length
// is the longer side of the image, but heights are in mm. Texture coordinates start at the top left.

export const kVertex = `#version 300 es
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  at = vec2(corner.x, 1.0 - corner.y);
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}`;

export const kFragment = `#version 300 es
precision highp float;
precision highp sampler2D;
in vec2 at;
out vec4 colour;
uniform sampler2D image, heights, relief, leans;
uniform vec2 extent;     // of the image, in its longer side
uniform vec2 node;       // one node of the sheet, in texture coordinates
uniform vec2 gloss;      // power and peak of the mirrored light; peak below 0: as published, smooth and dull
uniform float spacing;   // from node to node, mm
uniform float longer;    // the longer side, mm
uniform float parallax;  // 1, or 0 where motion is to be reduced
uniform float full;      // depth of a full press, mm
uniform float pile;      // slope of the hairs that lean most
const vec3 light = vec3(-0.45, -0.6, 0.6614378);
const float deep = 18.0, halfMm = 0.8;
const float eyeBelow = 0.5, ambient = 0.35, skyReach = 0.09;
const float slopeLow = 0.25, slopeHigh = 1.5, shadow = 0.55, shadowReach = 0.12;
const float steeper = 2.0, steepest = 0.8, flattenMm = 3.0, hairMm = 2.0, bright = 0.7, headroom = 0.75;
const vec3 halfway = normalize(light + normalize(vec3(0.0, eyeBelow, 1.0)));

float relieved(float e) {
  return deep * e / (1.0 + abs(e) / halfMm);
}

// As it is drawn.
float height(vec2 uv) {
  float e = texture(heights, uv).r;
  if (gloss.y < 0.0) return relieved(e);
  float part = e * e / (full * full);
  return 0.5 * (relieved(e) - relieved(full) * 1.1 * part / (part + 0.1));
}

float along(vec2 n, vec3 to) {
  return dot(vec3(n, 1.0), to) * inversesqrt(dot(n, n) + 1.0);
}

// Light of the sun on a slope.
float sun(vec2 n) {
  return (1.0 - ambient) * max(along(n, light), 0.0) / light.z;
}

// Share of it that is mirrored.
float mirrored(vec2 n) {
  float t = max(along(n, halfway), 1e-3);
  return gloss.y * t / (gloss.x - gloss.x * t + t);
}

void main() {
  vec2 eye = vec2(0.5, 0.5) + vec2(0.0, eyeBelow) / extent;
  vec2 uv = at;
  for (int i = 0; i < 6; ++i) uv = at + (at - eye) * (-height(uv) * parallax / longer);
  vec2 n = vec2(height(uv - vec2(node.x, 0.0)) - height(uv + vec2(node.x, 0.0)),
                height(uv - vec2(0.0, node.y)) - height(uv + vec2(0.0, node.y))) * (0.5 / spacing);
  float here = height(uv), horizon = 0.0;
  vec2 toLight = normalize(light.xy);
  for (int i = 1; i <= 8; ++i) {
    float away = shadowReach * float(i * i) / 64.0;
    horizon = max(horizon, (height(uv + toLight * away / extent) - here) / (away * longer));
  }
  float hidden = clamp((horizon - slopeLow) / (slopeHigh - slopeLow), 0.0, 1.0);
  vec2 d = skyReach / extent;
  float walls = (height(uv - vec2(d.x, 0.0)) + height(uv + vec2(d.x, 0.0)) + height(uv - vec2(0.0, d.y)) +
    height(uv + vec2(0.0, d.y))) * 0.25;
  float m = (walls - here) / (skyReach * longer);
  float open = 1.0 - shadow * hidden;
  vec2 lean = pile * texture(leans, uv).rg;
  uv -= lean * (hairMm * parallax / longer) / extent;
  vec4 base = texture(image, uv);
  if (gloss.y < 0.0) {
    colour = vec4(base.rgb * pow(min(ambient / (1.0 + m * max(m, 0.0)) + sun(n) * open, 2.0), 1.0 / 2.2), base.a);
  } else {
    vec2 r = (255.0 * texture(relief, uv).rg - 128.0) * (0.75 / 127.0);
    n *= steeper;
    n *= inversesqrt(1.0 + dot(n, n) / (steepest * steepest));
    n += r / (1.0 + max(-here, 0.0) / flattenMm);
    float now = sun(n) * open, atRest = sun(r), shine = now * mirrored(n), more = max(shine - atRest * mirrored(r), 0.0);
    float side = dot(lean, light.xy);
    vec3 own = pow(base.rgb, vec3(2.2)), knee = max(own, bright);
    vec3 lit = own * ((ambient + now) * (1.0 - m * inversesqrt(1.0 + 4.0 * m * m)) * (1.0 - side) / ((1.0 + side) * (ambient + atRest))) + more * more / max(shine, 1e-9);
    vec3 room = headroom * (1.0 - knee), over = max(lit - knee, 0.0);
    lit = min(lit, knee) + room * over / max(room + over, 1e-6);
    colour = vec4(pow(lit, vec3(1.0 / 2.2)), base.a);
  }
  colour.rgb *= colour.a;
}`;

// SPDX-License-Identifier: MIT
// The material of the part: sawn where the blank is untouched, bright where it is machined, and the colour of data over
// the bright. Untouched is a triangle whose vertices all lie on the blank.

import { Color, MeshStandardMaterial } from "three";

import { SAW_MARKS } from "@tribo/ui/saw_marks";
import { MACHINED, MARKS, PAINT, SAWN } from "@tribo/ui/studio";
import type { ContactUniforms } from "./contact.js";
import type { Palette } from "./palette.js";

// `blank` is 1 on the surface of the blank. `tint` has the colour of data times its weight, and the weight, 0 or 1.
const VERTEX_HEAD = /* glsl */ `
attribute float blank;
attribute vec4 tint;
varying float vBlank;
varying vec4 vTint;
varying vec3 vPlace;
void main() {
  vBlank = blank;
  vTint = tint;
  vPlace = position;`;

const FRAGMENT_HEAD = /* glsl */ `
varying float vBlank;
varying vec4 vTint;
varying vec3 vPlace;
uniform vec3 sawnColour;
uniform float shine;
uniform float contactOn;
uniform vec2 contactSize;
uniform vec2 contactRange;
uniform sampler2D contactDepth;
uniform mat4 projectionMatrix;
${SAW_MARKS}
#ifdef CONTACT
vec3 placeAt(vec2 pixel) {
  vec2 at = pixel / contactSize;
  float depth = texture2D(contactDepth, at).r;
  float z = contactRange.x * contactRange.y / ((contactRange.y - contactRange.x) * depth - contactRange.y);
  vec2 ndc = 2.0 * at - 1.0;
  return vec3(-z * (ndc + vec2(projectionMatrix[2][0], projectionMatrix[2][1])) /
    vec2(projectionMatrix[0][0], projectionMatrix[1][1]), z);
}
// The share of the sky that neighbours within some pixels leave free (after McGuire et al. 2011, Alchemy obscurance).
float openness(vec3 p, vec3 n) {
  const int samples = 12;
  const float pixels = 20.0;
  float perPixel = -p.z / (0.5 * contactSize.y * projectionMatrix[1][1]);
  float radius = pixels * perPixel;
  float turn = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float hidden = 0.0;
  for (int k = 0; k < samples; ++k) {
    float r = (float(k) + 0.5) / float(samples), a = 2.4 * float(k) + turn;
    vec3 v = placeAt(gl_FragCoord.xy + pixels * r * vec2(cos(a), sin(a))) - p;
    float d2 = dot(v, v);
    float near = clamp(1.0 - d2 / (4.0 * radius * radius), 0.0, 1.0);
    hidden += near * max(0.0, dot(v, n) - 0.3 * perPixel) / (d2 + 0.04 * radius * radius);
  }
  return clamp(1.0 - 1.1 * radius * hidden / float(samples), 0.25, 1.0);
}
#endif`;

const COLOUR = /* glsl */ `
  bool untouched = vBlank > 0.999;
  float data = untouched ? 0.0 : step(0.02, vTint.a);
  float marks = untouched ? sawMarks(vPlace) : 0.0;
  if (untouched) diffuseColor.rgb = sawnColour * (1.0 + ${MARKS} * marks);
  if (data > 0.0) diffuseColor.rgb = pow(vTint.rgb / vTint.a, vec3(2.2));`;
const ROUGHNESS = /* glsl */ `
  roughnessFactor = mix(untouched ? ${SAWN.roughness} + 0.2 * marks : roughness, ${PAINT.roughness}, max(data, 1.0 - shine));`;
const METALNESS = /* glsl */ `
  metalnessFactor = mix(untouched ? ${SAWN.metalness} : metalness, 0.0, data) * shine + 0.12 * (1.0 - shine);`;
const CONTACT = /* glsl */ `
#ifdef CONTACT
  if (contactOn > 0.0) outgoingLight *= openness(-vViewPosition, normal);
#endif`;

export class PartMaterial extends MeshStandardMaterial {
  private readonly sawnColour = { value: new Color() };
  private readonly shine = { value: 0 };
  private palette: Palette;
  private fine = false;

  constructor(palette: Palette, contact: ContactUniforms) {
    super({ flatShading: true, metalness: MACHINED.metalness, roughness: MACHINED.roughness });
    this.palette = palette;
    this.choose();
    this.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, contact, { sawnColour: this.sawnColour, shine: this.shine });
      shader.vertexShader = shader.vertexShader.replace("void main() {", VERTEX_HEAD);
      shader.fragmentShader = shader.fragmentShader
        .replace("void main() {", `${FRAGMENT_HEAD}\nvoid main() {`)
        .replace("#include <color_fragment>", `#include <color_fragment>${COLOUR}`)
        .replace("#include <roughnessmap_fragment>", `#include <roughnessmap_fragment>${ROUGHNESS}`)
        .replace("#include <metalnessmap_fragment>", `#include <metalnessmap_fragment>${METALNESS}`)
        .replace("#include <opaque_fragment>", `${CONTACT}\n#include <opaque_fragment>`);
    };
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    this.choose();
  }
  setFine(fine: boolean): void {
    this.fine = fine;
    // The shader of the first picture is short.
    this.defines = { ...this.defines };
    if (fine) this.defines.CONTACT = "";
    else delete this.defines.CONTACT;
    this.needsUpdate = true;
    this.choose();
  }

  // Metal without reflections would be black.
  private choose(): void {
    this.color.set(this.palette.machined);
    this.sawnColour.value.set(this.palette.untouched);
    this.shine.value = this.fine && this.palette.metal ? 1 : 0;
  }
}

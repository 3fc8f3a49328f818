// SPDX-License-Identifier: MIT
// A part in 3D: WebGL 2 without a library, drawn only after changes.

import type { Vec3 } from "@tribo/protocol/vec3";
import type { Part } from "./data.js";
import { Camera } from "./part_camera.js";
import { FRAGMENT } from "./part_finish.js";
import { listenToHands } from "./part_hands.js";
import { room, ROOM_SIDE } from "./part_room.js";
import { kMarkFragment, kMarkVertex, kPartVertex } from "./part_shader.js";
import { element, fitToScreen, vec3 } from "./shared.js";
import { USUAL_VIEW } from "@tribo/ui/studio";

const MOST_PIXEL_RATIO = 2;
const MARK_PX = 13;
// More vertices need longer indices.
const MOST_SHORT = 65_536;

const USUAL_TURN = Math.atan2(USUAL_VIEW[1], USUAL_VIEW[0]);

type Uniform = (name: string) => WebGLUniformLocation | null;

function link(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram | undefined {
  const made = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return gl.getProgramParameter(made, gl.LINK_STATUS) ? made : undefined;
}

/** The bytes that the page holds in base64 in an element. */
export const bytesIn = (id: string) => Uint8Array.from(atob(element(id).textContent.trim()), (c) => c.charCodeAt(0));

/**
 * Fills the buffers of the program with the bytes (layout: report_part.hpp). Returns the largest coordinates, in
 * steps.
 */
function load(gl: WebGL2RenderingContext, program: WebGLProgram, part: Part, bytes: Uint8Array): Vec3 {
  let at = 0;
  const take = (size: number) => bytes.subarray(at, (at += size));
  const places = take(6 * part.vertices);
  const deviations = take(part.deviation_step === undefined ? 0 : 2 * part.vertices);
  const indices = take((part.vertices > MOST_SHORT ? 12 : 6) * part.triangles);
  const untouched = take(part.vertices);
  const attribute = (name: string, list: Uint8Array, size: number, type: number) => {
    const where = gl.getAttribLocation(program, name);
    if (where < 0 || !list.length) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, list, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(where);
    gl.vertexAttribPointer(where, size, type, false, 0, 0);
  };
  gl.useProgram(program);
  attribute("place", places, 3, gl.UNSIGNED_SHORT);
  attribute("deviation", deviations, 1, gl.SHORT);
  attribute("untouched", untouched, 1, gl.UNSIGNED_BYTE);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  const corners = new Uint16Array(places.buffer, places.byteOffset, 3 * part.vertices);
  return vec3((k) => corners.reduce((m, v, i) => (i % 3 === k ? Math.max(m, v) : m), 0));
}

function loadRoom(gl: WebGL2RenderingContext): void {
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, ROOM_SIDE, ROOM_SIDE, 0, gl.RGBA, gl.FLOAT, room());
  for (const of of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, of, gl.LINEAR);
  for (const of of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, of, gl.CLAMP_TO_EDGE);
}

export interface SceneOptions {
  part: Part;
  bytes: Uint8Array;
  /** The tip of the tool; undefined: not shown. */
  tip: () => Vec3 | undefined;
  /** Called when the graphics come or are lost. */
  show: (on: boolean) => void;
  /** Called in place of redraw() when the camera moves: a camera may belong to several scenes. */
  moved?: () => void;
  /** Of another scene, to share it. */
  camera?: Camera;
}

export interface Scene {
  camera: Camera;
  redraw: () => void;
  colourBy: (deviation: boolean) => void;
}

/** Undefined: there is no WebGL 2. */
export function partScene(canvas: HTMLCanvasElement, options: SceneOptions): Scene | undefined {
  const { part } = options;
  const gl = canvas.getContext("webgl2", { antialias: true, premultipliedAlpha: true, preserveDrawingBuffer: true });
  if (!gl) return undefined;
  const program = link(gl, kPartVertex, FRAGMENT);
  const mark = link(gl, kMarkVertex, kMarkFragment);
  if (!program || !mark) return undefined;
  const ofPart: Uniform = (name) => gl.getUniformLocation(program, name);
  const ofMark: Uniform = (name) => gl.getUniformLocation(mark, name);

  loadRoom(gl);
  const top = load(gl, program, part, options.bytes);
  const half = vec3((k) => 0.5 * part.step * top[k]);
  const centre = vec3((k) => part.origin[k] + half[k]);
  const camera = options.camera ?? new Camera(centre, half);
  const indexType = part.vertices > MOST_SHORT ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT;
  let byDeviation = false;
  let wanted = false;

  const draw = () => {
    wanted = false;
    const { clientWidth, clientHeight } = canvas;
    if (clientWidth < 1 || clientHeight < 1 || gl.isContextLost()) return;
    const ratio = fitToScreen(canvas, MOST_PIXEL_RATIO);
    const { from, matrix } = camera.view(canvas.width / canvas.height);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    gl.uniformMatrix4fv(ofPart("view"), false, matrix);
    gl.uniform3fv(ofPart("origin"), part.origin);
    gl.uniform3f(ofPart("scales"), part.step, part.deviation_step ?? 0, part.deviation_range ?? 1);
    gl.uniform3fv(ofPart("eye"), from);
    gl.uniform2f(ofPart("turn"), Math.cos(camera.turn - USUAL_TURN), Math.sin(camera.turn - USUAL_TURN));
    gl.uniform1i(ofPart("deviations"), Number(byDeviation));
    gl.drawElements(gl.TRIANGLES, 3 * part.triangles, indexType, 0);
    const tip = options.tip();
    if (!tip) return;
    gl.useProgram(mark);
    gl.uniformMatrix4fv(ofMark("view"), false, matrix);
    gl.uniform3fv(ofMark("tip"), tip);
    gl.uniform1f(ofMark("size"), MARK_PX * ratio);
    gl.drawArrays(gl.POINTS, 0, 1);
  };
  const redraw = () => {
    if (wanted) return;
    wanted = true;
    requestAnimationFrame(draw);
  };
  listenToHands(canvas, camera, options.moved ?? redraw);
  canvas.addEventListener("webglcontextlost", () => options.show(false));
  options.show(true);
  new ResizeObserver(redraw).observe(canvas);
  redraw();
  return {
    camera,
    redraw,
    colourBy(deviation) {
      byDeviation = deviation;
      redraw();
    },
  };
}

/** Writes the ends of the scale of the deviations. */
export function nameScale(scale: HTMLElement, range: string, less: string, more: string): void {
  const ends = [`−${range} mm ${less}`, "0", `+${range} mm ${more}`];
  scale.querySelectorAll("span").forEach((end, i) => (end.textContent = ends[i]!));
}

// SPDX-License-Identifier: MIT
// One WebGL2 context for all elements of a page (browsers allow only about sixteen). Image and heights of each
// element are textures of this context. Each frame is drawn into a corner of it and copied to the canvas of the
// element.
import type { Changes, Leans } from "./engine.js";
import { kFragment, kVertex } from "./shader.js";

/** Data that an element shows. Its textures are in the shared context until free() is called. */
export interface Picture {
  image: HTMLImageElement;
  /** Nodes of the sheet. */
  nodesX: number;
  nodesY: number;
  spacingMm: number;
  /** Share of the light reflected as in a mirror, and its spread; absent: as published, smooth and matt. */
  finish: { gloss: number; roughness: number; pile?: number } | undefined;
  /** Slopes of the small relief in red and green, when they are known. */
  relief?: ImageData;
}

// Textures of a picture, in the order of their units.
const kTextures = ["image", "heights", "relief", "leans"] as const;
const kUniforms = [...kTextures, "gloss", "extent", "node", "spacing", "longer", "parallax", "full", "pile"] as const;
type Uniforms = Record<(typeof kUniforms)[number], WebGLUniformLocation | null>;

function shader(gl: WebGL2RenderingContext, type: number, source: string): WebGLShader {
  const made = gl.createShader(type)!;
  gl.shaderSource(made, source);
  gl.compileShader(made);
  return made;
}

export class Renderer extends EventTarget {
  readonly canvas = document.createElement("canvas");
  #gl: WebGL2RenderingContext;
  #program: WebGLProgram | null = null;
  #uniforms!: Uniforms;
  #floatHeights = false;
  #textures = new Map<Picture, WebGLTexture[]>();
  #largest = 4096;

  constructor() {
    super();
    const gl = this.canvas.getContext("webgl2", {
      alpha: true,
      antialias: false,
      depth: false,
      stencil: false,
      powerPreference: "low-power",
    });
    if (gl === null) throw new Error("WebGL2 is not available");
    this.#gl = gl;
    this.#prepare();
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.#program = null;
      this.#textures.clear();
      this.dispatchEvent(new Event("lost"));
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.#prepare();
      this.dispatchEvent(new Event("restored"));
    });
  }

  get lost(): boolean {
    return this.#program === null;
  }

  get pictures(): number {
    return this.#textures.size;
  }

  #prepare(): void {
    const gl = this.#gl;
    this.#floatHeights = gl.getExtension("OES_texture_float_linear") !== null;
    this.#largest = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
    const program = gl.createProgram();
    gl.attachShader(program, shader(gl, gl.VERTEX_SHADER, kVertex));
    gl.attachShader(program, shader(gl, gl.FRAGMENT_SHADER, kFragment));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(`the shader does not link: ${gl.getProgramInfoLog(program)}`);
    }
    this.#uniforms = Object.fromEntries(kUniforms.map((n) => [n, gl.getUniformLocation(program, n)])) as Uniforms;
    gl.useProgram(program);
    kTextures.forEach((name, unit) => gl.uniform1i(this.#uniforms[name], unit));
    this.#program = program;
  }

  add(picture: Picture): void {
    const gl = this.#gl;
    if (this.lost || this.#textures.has(picture)) return;
    this.#textures.set(
      picture,
      kTextures.map(() => gl.createTexture()),
    );
    this.#bind(picture, "image");
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, this.#fitting(picture.image));
    this.#smooth(true);
    this.#bind(picture, "heights");
    gl.texStorage2D(gl.TEXTURE_2D, 1, this.#floatHeights ? gl.R32F : gl.R16F, picture.nodesX, picture.nodesY);
    this.#smooth();
    this.lean(picture, { width: 1, height: 1, values: new Float32Array(2) });
    this.relieve(picture);
  }

  /** Makes this texture of the picture the current one of its unit. Returns whether there is one. */
  #bind(picture: Picture, name: (typeof kTextures)[number]): boolean {
    const unit = kTextures.indexOf(name);
    const texture = this.#textures.get(picture)?.[unit];
    if (texture === undefined) return false;
    this.#gl.activeTexture(this.#gl.TEXTURE0 + unit);
    this.#gl.bindTexture(this.#gl.TEXTURE_2D, texture);
    return true;
  }

  /** Sets the small relief of the picture; until then it is smooth. */
  relieve(picture: Picture): void {
    const gl = this.#gl;
    if (!this.#bind(picture, "relief")) return;
    gl.texImage2D(
      gl.TEXTURE_2D,
      0,
      gl.RG8,
      gl.RG,
      gl.UNSIGNED_BYTE,
      picture.relief ?? new ImageData(new Uint8ClampedArray([128, 128, 0, 255]), 1),
    );
    this.#smooth(true);
  }

  lean(picture: Picture, { width, height, values }: Leans): void {
    const gl = this.#gl;
    if (!this.#bind(picture, "leans")) return;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG16F, width, height, 0, gl.RG, gl.FLOAT, values);
    this.#smooth();
  }

  /** Interpolation of the current texture; `small` ones of it serve where it is drawn smaller. */
  #smooth(small = false): void {
    const gl = this.#gl;
    if (small) gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, small ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  }

  /** Returns the image, reduced if it is larger than the maximum texture. */
  #fitting(image: HTMLImageElement): TexImageSource {
    const most = Math.min(this.#largest, 4096);
    const scale = most / Math.max(image.naturalWidth, image.naturalHeight);
    if (scale >= 1) return image;
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(1, Math.floor(image.naturalWidth * scale));
    canvas.height = Math.max(1, Math.floor(image.naturalHeight * scale));
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    return canvas;
  }

  free(picture: Picture): void {
    for (const texture of this.#textures.get(picture) ?? []) this.#gl.deleteTexture(texture);
    this.#textures.delete(picture);
  }

  upload(picture: Picture, changes: Changes): void {
    const gl = this.#gl;
    if (!this.#bind(picture, "heights")) return;
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, changes.stride);
    gl.texSubImage2D(
      gl.TEXTURE_2D,
      0,
      changes.x,
      changes.y,
      changes.width,
      changes.height,
      gl.RED,
      gl.FLOAT,
      changes.values,
    );
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
  }

  /** Draws the picture and copies it to a canvas of the element. `fullMm`: depth of a full press. */
  draw(picture: Picture, to: CanvasRenderingContext2D, parallax: boolean, fullMm: number): boolean {
    const gl = this.#gl;
    for (const name of kTextures) if (!this.#bind(picture, name)) return false;
    const { width, height } = to.canvas;
    if (this.canvas.width < width || this.canvas.height < height) {
      this.canvas.width = Math.max(this.canvas.width, width);
      this.canvas.height = Math.max(this.canvas.height, height);
    }
    gl.viewport(0, this.canvas.height - height, width, height);
    const { gloss, roughness, pile = 0 } = picture.finish ?? { gloss: -1, roughness: 1 };
    const power = 2 / roughness ** 2 - 2;
    gl.uniform2f(this.#uniforms.gloss, power, (gloss * (power + 2)) / 8);
    const longer = Math.max(picture.nodesX, picture.nodesY);
    gl.uniform2f(this.#uniforms.extent, picture.nodesX / longer, picture.nodesY / longer);
    gl.uniform2f(this.#uniforms.node, 1 / picture.nodesX, 1 / picture.nodesY);
    gl.uniform1f(this.#uniforms.spacing, picture.spacingMm);
    gl.uniform1f(this.#uniforms.longer, longer * picture.spacingMm);
    gl.uniform1f(this.#uniforms.pile, pile);
    gl.uniform1f(this.#uniforms.full, fullMm);
    gl.uniform1f(this.#uniforms.parallax, Number(parallax));
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    to.globalCompositeOperation = "copy";
    to.drawImage(this.canvas, 0, 0, width, height, 0, 0, width, height);
    return true;
  }

  /** For tests: loses the context and restores it, as a browser may do. */
  get loseContext(): WEBGL_lose_context | null {
    return this.#gl.getExtension("WEBGL_lose_context");
  }
}

let shared: Renderer | undefined;

/** Returns the renderer of the page. Throws if there is no WebGL2. */
export function renderer(): Renderer {
  shared ??= new Renderer();
  return shared;
}

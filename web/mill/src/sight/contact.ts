// SPDX-License-Identifier: MIT
// Depths of part and tool, as the camera sees them, for the contact shading of the part (metal.ts).

import {
  DepthTexture,
  MeshBasicMaterial,
  type PerspectiveCamera,
  type Scene,
  type Texture,
  Vector2,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";

// Objects on this layer are seen by the depths.
export const CONTACT_LAYER = 1;

export interface ContactUniforms {
  contactOn: { value: number };
  contactDepth: { value: Texture | null };
  contactSize: { value: Vector2 }; // of the picture, pixels
  contactRange: { value: Vector2 }; // of the camera, mm
}

export class Contact {
  readonly uniforms: ContactUniforms = {
    contactOn: { value: 0 },
    contactDepth: { value: null },
    contactSize: { value: new Vector2(1, 1) },
    contactRange: { value: new Vector2(1, 2) },
  };
  private target: WebGLRenderTarget | undefined;
  private readonly depthOnly = new MeshBasicMaterial({ colorWrite: false });

  setFine(fine: boolean): void {
    this.uniforms.contactOn.value = fine ? 1 : 0;
    if (fine) return;
    this.target?.dispose();
    this.target = undefined;
    this.uniforms.contactDepth.value = null;
  }

  render(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera): void {
    if (this.uniforms.contactOn.value === 0) return;
    const size = renderer.getDrawingBufferSize(this.uniforms.contactSize.value);
    this.uniforms.contactRange.value.set(camera.near, camera.far);
    if (!this.target) {
      this.target = new WebGLRenderTarget(size.x, size.y, { depthTexture: new DepthTexture(size.x, size.y) });
    } else if (this.target.width !== size.x || this.target.height !== size.y) {
      this.target.setSize(size.x, size.y);
    }
    // A texture cannot be read while it is drawn.
    this.uniforms.contactDepth.value = null;
    const shadowsWait = renderer.shadowMap.needsUpdate;
    renderer.shadowMap.needsUpdate = false;
    const { layers } = camera;
    const mask = layers.mask;
    layers.set(CONTACT_LAYER);
    scene.overrideMaterial = this.depthOnly;
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    scene.overrideMaterial = null;
    layers.mask = mask;
    renderer.shadowMap.needsUpdate = shadowsWait;
    this.uniforms.contactDepth.value = this.target.depthTexture;
  }
}

// SPDX-License-Identifier: MIT
// The light on the bench: a small procedural studio that metal reflects, one sun with a soft shadow, and the ground that
// the shadow falls on. The plain look has a sky and the sun, without reflections and shadow.

import {
  BackSide,
  type Box3,
  BufferAttribute,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  PlaneGeometry,
  PMREMGenerator,
  Scene,
  ShadowMaterial,
  SphereGeometry,
  type Texture,
  Vector3,
  type WebGLRenderer,
} from "three";

import { PANEL_DISTANCE, PANELS, SUN, wallAt } from "@tribo/ui/studio";

const SHADOW_PIXELS = 2048;
const TO_SUN = new Vector3(...SUN.towards).normalize();

// What metal reflects.
function studio(renderer: WebGLRenderer): Texture {
  const room = new Scene();
  const sphere = new SphereGeometry(10, 24, 24).rotateX(Math.PI / 2);
  const place = sphere.getAttribute("position");
  const shade = new Float32Array(3 * place.count);
  for (let n = 0; n < place.count; ++n) {
    shade.fill(wallAt(place.getZ(n) / 10), 3 * n, 3 * n + 3);
  }
  sphere.setAttribute("color", new BufferAttribute(shade, 3));
  room.add(new Mesh(sphere, new MeshBasicMaterial({ side: BackSide, vertexColors: true })));
  for (const { towards, width, height, brightness } of PANELS) {
    const panel = new Mesh(new PlaneGeometry(width, height), new MeshBasicMaterial());
    panel.material.color.setScalar(brightness);
    panel.position.set(...towards).setLength(PANEL_DISTANCE);
    panel.up.set(0, 0, 1);
    panel.lookAt(0, 0, 0);
    room.add(panel);
  }
  const generator = new PMREMGenerator(renderer);
  const { texture } = generator.fromScene(room, 0.01);
  generator.dispose();
  room.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    object.geometry.dispose();
    (object.material as MeshBasicMaterial).dispose();
  });
  return texture;
}

export class Light {
  // In the frame of the part.
  readonly group = new Group();
  private readonly sky = new HemisphereLight(0xffffff, 0x8f98a6, 2.3);
  private readonly headlight = new DirectionalLight(0xffffff, 2.7);
  private readonly sun = new DirectionalLight(SUN.colour, SUN.strength);
  private readonly ground = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.3 }));
  private reflections: Texture | undefined;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly scene: Scene,
    camera: Object3D,
  ) {
    this.headlight.position.set(-0.6, 0.9, 1);
    camera.add(this.headlight);
    const { shadow } = this.sun;
    shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    shadow.radius = 4;
    shadow.intensity = 0.85;
    this.ground.receiveShadow = true;
    this.group.add(this.sky, this.sun, this.sun.target, this.ground);
    renderer.shadowMap.autoUpdate = false;
    this.setFine(false);
  }

  get fine(): boolean {
    return this.sun.visible;
  }

  setFine(fine: boolean): void {
    if (fine) this.reflections ??= studio(this.renderer);
    this.scene.environment = fine ? this.reflections! : null;
    this.renderer.shadowMap.enabled = fine;
    this.sky.visible = this.headlight.visible = !fine;
    this.sun.visible = this.sun.castShadow = this.ground.visible = fine;
    this.changed();
  }

  // Something that throws a shadow has moved.
  changed(): void {
    this.renderer.shadowMap.needsUpdate = true;
  }

  // The studio goes round the part with the viewer, so that metal is as bright and grooves read as well from every side as
  // from the side `usual`. Both directions are those from the part.
  follow(viewer: Vector3, usual: Vector3): void {
    this.scene.environmentRotation.z = Math.atan2(viewer.y, viewer.x) - Math.atan2(usual.y, usual.x);
  }

  // Light and shadow for a part in this box; the tool is up to `above` over it, mm.
  begin(box: Box3, above: number): void {
    const centre = box.getCenter(new Vector3());
    const size = box.getSize(new Vector3()).length();
    const reach = 0.5 * size + 0.5 * above;
    this.sun.target.position.copy(centre);
    this.sun.position.copy(centre).addScaledVector(TO_SUN, 4 * size);
    const { camera } = this.sun.shadow;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    camera.near = size;
    camera.far = 7 * size;
    camera.updateProjectionMatrix();
    const cell = (2 * reach) / SHADOW_PIXELS;
    this.sun.shadow.normalBias = 1.5 * cell;
    this.sun.shadow.bias = -1e-4;
    // A little lower than the part, which stands on it.
    this.ground.position.set(centre.x, centre.y, box.min.z - 2e-3 * size);
    this.ground.scale.setScalar(8 * size);
    this.changed();
  }
}

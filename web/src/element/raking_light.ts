// SPDX-License-Identifier: Apache-2.0
//
// A lamp that the visitor holds beside the camera: its light grazes what is looked at, and shows the relief of a scan.
import type { Camera, DirectionalLight, WebGLRenderer } from 'three';
import { aroundRender } from './around_render.js';
import { beginsWith } from './attribute_life.js';
import type { Kit } from './extras.js';
import { createHandle } from './lamp_handle.js';
import type { LightwellView } from './lightwell_view.js';

/** From the upper left, as drawings have it: the angle in the picture from its right side on, and above the picture, in radians. */
const ANGLE = (3 / 4) * Math.PI;
const HEIGHT = Math.PI / 9;
/** A white surface that faces the lamp would be so many times as bright as white: what is grazed has its full range. */
const BRIGHTNESS = 1.4;
/** All other light is so much weaker while the lamp is on: it fills the shadows. */
const FILL = 1 / 4;
const SHADOW_MAP_SIZE = 2048;

const lamps = new WeakMap<LightwellView, RakingLamp>();

/** Holds the lamp while the attribute `raking-light` is there, where its value says: "135deg 20deg". */
export function rakingLight(view: LightwellView, kit: Kit): void {
  const end = beginsWith(view, 'raking-light');
  if (end !== null && !end.aborted) lamps.set(view, new RakingLamp(view, new kit.DirectionalLight(), end));
  const [angle, height] = (view.getAttribute('raking-light') ?? '').split(/\s+/).map(kit.parseQuantity);
  lamps.get(view)?.hold(angle ?? ANGLE, height ?? HEIGHT);
}

class RakingLamp {
  readonly #view: LightwellView;
  readonly #lamp: DirectionalLight;
  readonly #handle = createHandle((x, y) => this.#aim(x, y));
  /** Where the light comes from, to the right, up and towards the camera. */
  #from: [number, number, number] = [0, 0, 1];
  #frame = 0;
  /** Under way, one in another: `compare` draws in the middle of a drawing. */
  #drawings = 0;

  constructor(view: LightwellView, lamp: DirectionalLight, end: AbortSignal) {
    this.#view = view;
    this.#lamp = lamp;
    const { scene } = view;
    lamp.castShadow = true;
    lamp.shadow.mapSize.set(SHADOW_MAP_SIZE, SHADOW_MAP_SIZE);
    lamp.shadow.bias = -0.0005;
    scene.add(lamp, lamp.target);
    view.shadowRoot!.append(this.#handle.element);
    aroundRender(scene, end, {
      before: (renderer) => {
        if (this.#drawings++ === 0) renderer.toneMappingExposure *= FILL;
        this.#follow(renderer, view.camera);
      },
      after: (renderer) => {
        if (--this.#drawings === 0) renderer.toneMappingExposure /= FILL;
      },
    });
    end.addEventListener('abort', () => {
      scene.remove(lamp, lamp.target);
      lamp.dispose();
      this.#handle.element.remove();
      view.invalidate();
    });
  }

  hold(angle: number, height: number): void {
    this.#handle.put(Math.cos(height) * Math.cos(angle), Math.cos(height) * Math.sin(angle));
  }

  /** From a place in the disc of directions. It is seen in the next frame, shadow and all: `invalidate` takes its time. */
  #aim(x: number, y: number): void {
    this.#from = [x, y, Math.sqrt(Math.max(0, 1 - x * x - y * y))];
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#view.draw();
    });
  }

  /** Goes where the camera goes, before a frame is drawn; its shadow is drawn anew when it has moved. */
  #follow({ shadowMap, toneMappingExposure }: WebGLRenderer, camera: Camera): void {
    const { pack } = this.#view;
    if (pack === null) return;
    const lamp = this.#lamp;
    const { min, max } = pack.focus;
    const radius = min.distanceTo(max) / 2;
    const middle = min.clone().lerp(max, 0.5);
    const place = min.clone().fromArray(this.#from).applyQuaternion(camera.quaternion).multiplyScalar(2 * radius).add(middle);
    lamp.intensity = (BRIGHTNESS * Math.PI) / toneMappingExposure;
    if (lamp.position.distanceTo(place) < 1e-6 * radius) return;
    lamp.position.copy(place);
    lamp.target.position.copy(middle);
    lamp.updateMatrixWorld();
    lamp.target.updateMatrixWorld();
    Object.assign(lamp.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: radius, far: 3 * radius });
    lamp.shadow.camera.updateProjectionMatrix();
    lamp.shadow.normalBias = radius / 500;
    shadowMap.needsUpdate = true;
  }
}

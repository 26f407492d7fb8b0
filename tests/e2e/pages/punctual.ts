// SPDX-License-Identifier: Apache-2.0
//
// Measures the irradiance of lamps on a white wall that faces them: of a pack's own kind and of three.js's.
import {
  Box3,
  FloatType,
  Group,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  OrthographicCamera,
  PlaneGeometry,
  PointLight,
  Scene,
  SpotLight,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { DirectLight } from '../../../web/src/three/direct/direct_light.js';
import { DIRECT_KIT } from '../../../web/src/three/direct_kit.js';
import type { LampDefinition } from '../../../web/src/three/extensions.js';
import { FrameScheduler } from '../../../web/src/three/frame_scheduler.js';
import type { Opening } from '../../../web/src/three/opening.js';

const renderer = new WebGLRenderer();
const target = new WebGLRenderTarget(1, 1, { type: FloatType });
const bounds = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));

/** Of a light at the origin that looks along -z, at a distance and an angle from there, on a wall that faces it; times pi / albedo. */
function irradiance(lights: Object3D[], distance: number, angle: number): number {
  const place = new Vector3(Math.sin(angle), 0, -Math.cos(angle)).multiplyScalar(distance);
  const wall = new Mesh(new PlaneGeometry(0.001, 0.001), new MeshLambertMaterial());
  wall.position.copy(place);
  wall.lookAt(0, 0, 0);
  const camera = new OrthographicCamera(-0.0001, 0.0001, 0.0001, -0.0001, 0, 10);
  camera.position.copy(place).multiplyScalar(0.5);
  camera.lookAt(place);
  const targets = lights.flatMap((light) => (light instanceof SpotLight ? [light.target] : []));
  renderer.setRenderTarget(target);
  renderer.render(new Scene().add(wall, ...lights, ...targets), camera);
  const pixel = new Float32Array(4);
  renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
  return pixel[0]! * Math.PI;
}

/** Of a pack's lamp, described as in LIGHTWELL_lamps, whose intensity is 1 W/sr. */
export function ofLamp(definition: Partial<LampDefinition>, distance: number, angle = 0): number {
  const lamp = { kind: 'point', center: [0, 0, 0], normal: [0, 0, -1], intensity: [1, 1, 1], ...definition } as LampDefinition;
  const opening = { gltf: { scene: new Group() }, meshesOf: () => [] } as unknown as Opening;
  const surroundings = { renderer, scheduler: FrameScheduler.of(renderer), bounds, focus: bounds, opening, environment: undefined, grids: [], changed: () => {} };
  const direct = new DirectLight(DIRECT_KIT, [lamp], surroundings);
  const measured = irradiance([direct.hook, direct.carrier, ...direct.lamps], distance, angle);
  direct.dispose();
  return measured;
}

/** Of a point light of three.js's own. */
export function ofPoint(distance: number, range: number): number {
  return irradiance([new PointLight(0xffffff, 1, range)], distance, 0);
}

/** Of a spot light of three.js's own. */
export function ofSpot(angle: number, outer: number, penumbra: number): number {
  const spot = new SpotLight(0xffffff, 1, 0, outer, penumbra);
  spot.position.set(0, 0, 0);
  spot.target.position.set(0, 0, -1);
  return irradiance([spot], 1, angle);
}

Object.assign(globalThis, { ofLamp, ofPoint, ofSpot });

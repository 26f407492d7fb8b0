// SPDX-License-Identifier: Apache-2.0
//
// Lamps without a pack: their irradiance on white surfaces, what gloss mirrors of them, and their shadows.
import {
  Box3,
  type Camera,
  DoubleSide,
  FloatType,
  Group,
  Mesh,
  MeshLambertMaterial,
  MeshPhysicalMaterial,
  type MeshPhysicalMaterialParameters,
  type Object3D,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { DirectLight } from '../../../web/src/three/direct/direct_light.js';
import { DIRECT_KIT } from '../../../web/src/three/direct_kit.js';
import type { LampDefinition, LightGridDefinition } from '../../../web/src/three/extensions.js';
import { FrameScheduler } from '../../../web/src/three/frame_scheduler.js';
import { LightwellLight } from '../../../web/src/three/light.js';
import type { Opening } from '../../../web/src/three/opening.js';

type Triple = [number, number, number];

const renderer = new WebGLRenderer();
const bounds = new Box3(new Vector3(-2, -2, -2), new Vector3(2, 2, 2));
/** Milliseconds of a frame, so that samples come as fast as they can. */
export const ALL_TIME = 10_000;

/** How many of them the GPU holds. */
export const countTextures = () => renderer.info.memory.textures;

export interface Lit {
  direct: DirectLight;
  scene: Scene;
  /** How often a better picture could be drawn. */
  changes: number;
}

/** Half floats: what a grid's first coefficient is where the irradiance is that of an open sky of radiance 1, pi. */
const OPEN_SKY = 0x4317;

/** A grid of a pack whose sky is apart, black or as if nothing hid the sky anywhere, and the one that is shown in its place, which is black. */
function gridsOf(open: boolean): LightwellLight[] {
  const whole: LightGridDefinition = { stream: 0, min: [-2, -2, -2], cell: [4, 4, 4], nodes: [2, 2, 2], normalOffset: 0, contains: ['environment'] };
  return [whole, { ...whole, stream: -1, contains: [], insteadOf: whole }].map((definition) => {
    const atlas = { atlas: new Uint16Array(4 * 2 * 2 * 28), width: 2, height: 2, depth: 28 };
    const [one, weights] = [0x3c00, 4 * 2 * 2 * 24];
    atlas.atlas.fill(one, 0, 3);
    for (let at = weights + 3; at < atlas.atlas.length; at += 4) atlas.atlas[at] = one;
    // Behind the two texels of the header.
    if (open && definition === whole) for (let at = 8; at < 4 * 2 * 2 * 4; at += 4) atlas.atlas.fill(OPEN_SKY, at, at + 3);
    return new LightwellLight(definition, atlas);
  });
}

export function light(definitions: LampDefinition[], objects: Object3D[], grids: LightwellLight[] = []): Lit {
  const opening = { gltf: { scene: new Group() }, meshesOf: () => [] } as unknown as Opening;
  opening.gltf.scene.userData['lightwell'] = { skyRadiance: [1, 1, 1] };
  const changed = () => void lit.changes++;
  const surroundings = { renderer, scheduler: FrameScheduler.of(renderer), bounds, focus: bounds, opening, environment: undefined, grids, changed };
  const direct = new DirectLight(DIRECT_KIT, definitions, surroundings);
  const lit: Lit = { direct, scene: new Scene().add(direct.hook, direct.carrier, ...direct.lamps, ...grids.slice(0, 1), ...objects), changes: 0 };
  return lit;
}

/** Red of a row of pixels times pi: the irradiance on white. */
export function rowOf(scene: Scene, camera: Camera, width: number): number[] {
  const target = new WebGLRenderTarget(width, 1, { type: FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * width);
  renderer.readRenderTargetPixels(target, 0, 0, width, 1, pixels);
  renderer.setRenderTarget(null);
  target.dispose();
  return Array.from({ length: width }, (_, i) => pixels[4 * i]! * Math.PI);
}

export function surface(width: number, depth: number, place: Triple, towards: Triple): Mesh {
  const mesh = new Mesh(new PlaneGeometry(width, depth), new MeshLambertMaterial({ side: DoubleSide }));
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.position.set(...place);
  mesh.lookAt(new Vector3(...place).add(new Vector3(...towards)));
  return mesh;
}

/** Looks down a row along x, from y = 0.9 to below. */
export function rowCamera(half: number): OrthographicCamera {
  const camera = new OrthographicCamera(-half, half, 0.01, -0.01, 0, 2);
  camera.position.set(0, 0.9, 0);
  camera.up.set(0, 0, -1);
  camera.lookAt(0, 0, 0);
  return camera;
}

/** Of one lamp, with nothing in its way, on a surface at a place that faces somewhere. */
export function irradiance(definition: LampDefinition, place: Triple, normal: Triple): number {
  const { direct, scene } = light([definition], [surface(0.001, 0.001, place, normal)]);
  direct.setShadows('off');
  const camera = new OrthographicCamera(-0.0001, 0.0001, 0.0001, -0.0001, 0, 1);
  camera.position.set(...place).addScaledVector(new Vector3(...normal).normalize(), 0.01);
  camera.lookAt(new Vector3(...place));
  const [measured] = rowOf(scene, camera, 1);
  direct.dispose();
  return measured!;
}

/** What a surface at a place, of which all is gloss, sends towards somebody far away of one lamp with nothing in its way, a number for each material. */
export function mirrored(definition: LampDefinition, place: Triple, normal: Triple, viewer: Triple, materials: MeshPhysicalMaterialParameters[]): number[] {
  const seen = surface(0.001, 0.001, place, normal);
  const { direct, scene } = light([definition], [seen]);
  direct.setShadows('off');
  const camera = new OrthographicCamera(-0.0001, 0.0001, 0.0001, -0.0001, 0, 1);
  camera.position.set(...place).addScaledVector(new Vector3(...viewer).normalize(), 0.5);
  camera.lookAt(new Vector3(...place));
  const values = materials.map((parameters) => {
    seen.material = new MeshPhysicalMaterial({ color: 0, ...parameters });
    return rowOf(scene, camera, 1)[0]! / Math.PI;
  });
  direct.dispose();
  return values;
}

/** Lets so many samples of a row of pixels come. */
export async function settle(lit: Lit, camera: Camera, width: number, samples: number): Promise<void> {
  const { direct, scene } = lit;
  direct.setShadows('soft', ALL_TIME);
  rowOf(scene, camera, width);
  for (let seen = lit.changes; direct.samples < samples; seen = lit.changes) {
    while (lit.changes === seen) await new Promise(requestAnimationFrame);
    rowOf(scene, camera, width);
  }
}

/** A lamp above, a half-plane at y = 1 over x < 0, and the floor: what of the lamp reaches each pixel of a row from -half to half. */
export async function penumbra(definition: LampDefinition, half: number, samples: number): Promise<{ shares: number[]; changes: number; points: number }> {
  const objects = [surface(10, 10, [0, 0, 0], [0, 1, 0]), surface(10, 10, [-5, 1, 0], [0, 1, 0])];
  const lit = light([definition], objects);
  const camera = rowCamera(half);
  const width = 128;
  rowOf(lit.scene, camera, width);
  lit.direct.setShadows('off');
  const whole = rowOf(lit.scene, camera, width);
  await settle(lit, camera, width, samples);
  const shares = rowOf(lit.scene, camera, width).map((value, i) => value / whole[i]!);
  const points = lit.direct.samples;
  lit.direct.dispose();
  return { shares, changes: lit.changes, points };
}

/**
 * A lamp that has all its samples beside another one that is hidden, shown and hidden again: rows before and after, how many samples there are then,
 * and how many textures.
 */
export async function besideAnother(definition: LampDefinition): Promise<{ rows: number[][]; samples: number[]; textures: number[] }> {
  const objects = [surface(10, 10, [0, 0, 0], [0, 1, 0]), surface(10, 10, [-5, 1, 0], [0, 1, 0])];
  const lit = light([definition, { ...definition, center: [0.3, 2, 0] }], objects);
  const camera = rowCamera(0.48);
  const [, other] = lit.direct.lamps;
  const result = { rows: [] as number[][], samples: [] as number[], textures: [] as number[] };
  other!.visible = false;
  await settle(lit, camera, 128, Infinity);
  for (const visible of [false, true, false]) {
    other!.visible = visible;
    result.rows.push(rowOf(lit.scene, camera, 128));
    result.samples.push(lit.direct.samples);
    result.textures.push(countTextures());
  }
  lit.direct.dispose();
  return result;
}

export const wallUnderSky = (open: boolean): Lit =>
  light([], [surface(6, 6, [0, 0, 0], [0, 1, 0]), surface(6, 1, [0, 0.5, 0], [1, 0, 0])], gridsOf(open));

/**
 * A sky of radiance 1 over a white floor with a wall along z, 1 high: the irradiance of each pixel of a row from the wall on, `far` long. `open`:
 * whether the grid has the sky as if there were no wall.
 */
export async function skyBesideWall(far: number, samples: number, open = false): Promise<number[]> {
  const lit = wallUnderSky(open);
  const camera = rowCamera(far / 2);
  camera.position.x = far / 2;
  const width = 64;
  await settle(lit, camera, width, samples);
  const row = rowOf(lit.scene, camera, width);
  lit.direct.dispose();
  return row;
}

/** A sky of radiance 1 over an object that takes no shadows and has another one above it: the irradiance of a pixel of it. */
export async function skyOnOwnObject(samples: number): Promise<number> {
  const own = surface(1, 1, [0, 0, 0], [0, 1, 0]);
  own.receiveShadow = false;
  const lit = light([], [own, surface(3, 3, [0, 1.5, 0], [0, 1, 0])], gridsOf(false));
  const camera = rowCamera(0.1);
  await settle(lit, camera, 8, samples);
  const row = rowOf(lit.scene, camera, 8);
  lit.direct.dispose();
  return row[4]!;
}

/** The floor seen from above, when its front looks down. */
export function fromBehind(definition: LampDefinition): number[] {
  return [1, -1].map((up) => {
    const { direct, scene } = light([definition], [surface(4, 4, [0, 0, 0], [0, up, 0])]);
    const row = rowOf(scene, rowCamera(0.5), 16);
    direct.dispose();
    return Math.min(...row);
  });
}

/** What of a lamp reaches each pixel of a row across a surface that faces somewhere and has nothing in its way, with all samples. */
export async function onFlat(definition: LampDefinition, normal: Triple): Promise<number[]> {
  const lit = light([definition], [surface(4, 4, [0, 0, 0], normal)]);
  const camera = new OrthographicCamera(-1, 1, 0.01, -0.01, 0, 2);
  camera.position.set(...normal).normalize();
  camera.lookAt(0, 0, 0);
  lit.direct.setShadows('off');
  const whole = rowOf(lit.scene, camera, 64);
  await settle(lit, camera, 64, Infinity);
  const shares = rowOf(lit.scene, camera, 64).map((value, i) => value / whole[i]!);
  lit.direct.dispose();
  return shares;
}

/** A row of the floor below a lamp and the half-plane, all of it so many times as large. */
export function scaled(definition: LampDefinition, factor: number): number[] {
  const objects = [surface(10, 10, [0, 0, 0], [0, 1, 0]), surface(10, 10, [-5, 1, 0], [0, 1, 0])];
  const { direct, scene } = light([definition], objects);
  const camera = rowCamera(0.48);
  const world = new Group().add(...scene.children, camera);
  world.scale.setScalar(factor);
  camera.scale.setScalar(1 / factor);
  for (const side of ['left', 'right', 'top', 'bottom', 'far'] as const) camera[side] *= factor;
  camera.updateProjectionMatrix();
  const row = rowOf(new Scene().add(world), camera, 32);
  direct.dispose();
  return row;
}

/** The floor below a lamp, and once an object of the user's own is over it, and where that has gone aside. */
export function ownObject(definition: LampDefinition): number[] {
  const { direct, scene } = light([definition], [surface(10, 10, [0, 0, 0], [0, 1, 0])]);
  const middle = () => rowOf(scene, rowCamera(0.1), 8)[4]!;
  const own = surface(1, 1, [0, 0.95, 0], [0, 1, 0]);
  const values = [middle()];
  scene.add(own);
  values.push(middle());
  own.position.x = 5;
  values.push(middle());
  direct.dispose();
  return values;
}

Object.assign(globalThis, { besideAnother, onFlat, skyOnOwnObject, skyBesideWall, scaled, ownObject, irradiance, mirrored, penumbra, fromBehind });

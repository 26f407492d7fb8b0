// SPDX-License-Identifier: Apache-2.0
//
// What a view that comes after another one shows of shadows before it has samples of its own.
import { type Camera, PerspectiveCamera, Vector3 } from 'three';
import type { LampDefinition } from '../../../web/src/three/extensions.js';
import { countTextures, light, type Lit, rowCamera, rowOf, settle, surface, wallUnderSky } from './direct_light.js';

const WIDTH = 128;

/** A lamp above a floor, behind the edge of a half-plane. */
const create = (definition: LampDefinition): Lit => light([definition], [surface(10, 10, [0, 0, 0], [0, 1, 0]), surface(10, 10, [-5, 1, 0], [0, 1, 0])]);

/** Sees of the floor what is around x, `half` to both sides, from a height. */
function eyeAt(x: number, half: number, height: number): PerspectiveCamera {
  const camera = new PerspectiveCamera((2 * Math.atan(half / height / WIDTH) * 180) / Math.PI, WIDTH, 0.01, 2);
  camera.position.set(x, height, 0);
  camera.up.set(0, 0, -1);
  camera.lookAt(new Vector3(x, 0, 0));
  return camera;
}

const shot = ({ scene }: Lit, camera: Camera) => rowOf(scene, camera, WIDTH);

/**
 * After the camera has rested where it saw 0.48 to both sides of 0, it goes on over places, with no time for samples between them: the row of the floor around
 * the last of them in its first picture, and at rest; and those two for who has seen nothing before. And how many textures there are at rest, before and after.
 */
export async function movesOn(definition: LampDefinition, places: number[], half: number): Promise<Record<'first' | 'without' | 'rest' | 'alone' | 'textures', number[]>> {
  const lit = create(definition);
  await settle(lit, rowCamera(0.48), WIDTH, Infinity);
  const textures = [countTextures()];
  const cameras = places.map((x) => eyeAt(x, half, 0.8));
  const last = cameras[cameras.length - 1]!;
  const first = cameras.map((camera) => shot(lit, camera)).at(-1)!;
  await settleOn(lit, last);
  const rest = shot(lit, last);
  textures.push(countTextures());
  lit.direct.dispose();
  const other = create(definition);
  other.direct.setShadows('soft', 0);
  const without = shot(other, last);
  await settle(other, last, WIDTH, Infinity);
  const alone = shot(other, last);
  other.direct.dispose();
  return { first, without, rest, alone, textures };
}

/** Lets all samples come, and begins nothing anew. */
async function settleOn(lit: Lit, camera: Camera): Promise<void> {
  while (lit.direct.samples < Infinity) {
    await new Promise(requestAnimationFrame);
    shot(lit, camera);
  }
}

/** The first picture of a view beside the one where the camera has rested, after something else has changed, too, and that of who has seen nothing before. */
export async function changes(definition: LampDefinition, what: 'lamp' | 'object' | 'shadows'): Promise<number[][]> {
  const change = ({ direct, scene }: Lit) => {
    if (what === 'lamp') direct.lamps[0]!.position.x += 0.2;
    if (what === 'object') scene.add(surface(0.2, 0.2, [0.2, 0.95, 0], [0, 1, 0]));
    if (what === 'shadows') direct.setShadows('soft');
  };
  const camera = eyeAt(0.05, 0.4, 0.8);
  const lit = create(definition);
  await settle(lit, rowCamera(0.48), WIDTH, Infinity);
  change(lit);
  const other = create(definition);
  shot(other, rowCamera(0.48));
  change(other);
  const rows = [lit, other].map((of) => shot(of, camera));
  for (const { direct } of [lit, other]) direct.dispose();
  return rows;
}

/** The floor beside a wall under a sky, from 0.1 to 0.9: where the camera has rested, in the first picture from elsewhere, in its later ones and at rest. */
export async function underSky(): Promise<number[][]> {
  const lit = wallUnderSky(false);
  const camera = rowCamera(0.4);
  camera.position.x = 0.5;
  await settle(lit, camera, WIDTH, Infinity);
  const rows = [shot(lit, camera)];
  const next = eyeAt(0.5, 0.4, 0.8);
  rows.push(shot(lit, next));
  for (let seen = lit.changes; lit.direct.samples < Infinity; await new Promise(requestAnimationFrame)) {
    if (lit.changes === seen) continue;
    seen = lit.changes;
    rows.push(shot(lit, next));
  }
  rows.push(shot(lit, next));
  lit.direct.dispose();
  return rows;
}

/** Two cameras that take turns, of which one has rested before: its row then, and its last of so many turns. */
export async function takesTurns(definition: LampDefinition, turns: number): Promise<number[][]> {
  const lit = create(definition);
  const [camera, other] = [rowCamera(0.48), eyeAt(0.05, 0.4, 0.8)];
  await settle(lit, camera, WIDTH, Infinity);
  const rows = [shot(lit, camera)];
  for (let i = 0; i < turns; i++) {
    shot(lit, other);
    rows[1] = shot(lit, camera);
    await new Promise(requestAnimationFrame);
  }
  lit.direct.dispose();
  return rows;
}

Object.assign(globalThis, { movesOn, changes, underSky, takesTurns });

// SPDX-License-Identifier: Apache-2.0
//
// Loads /pack.lw.glb and tells what its parts are called.
import { Raycaster, Scene, Vector3, WebGLRenderer } from 'three';
import { LightwellLoader } from '../../../web/src/three/index.js';

const renderer = new WebGLRenderer();
const scene = new Scene();
const pack = await new LightwellLoader().setRenderer(renderer).loadAsync('pack.lw.glb');
const completed = new Promise<void>((resolve) => pack.addEventListener('complete', () => resolve()));
scene.add(pack);
scene.updateMatrixWorld(true);

/** The names of node and mesh, the extras and the bounds of what a ray down from above a place hits first. */
export function partBelow(x: number, y: number, z: number) {
  const [hit] = new Raycaster(new Vector3(x, y, z), new Vector3(0, -1, 0)).intersectObject(pack);
  const part = hit && pack.parts?.at(hit);
  return part && { node: part.node, mesh: part.mesh, bounds: [part.bounds.min.toArray(), part.bounds.max.toArray()] };
}

let meshes = 0;
pack.traverse((object) => void ('isMesh' in object && meshes++));

Object.assign(globalThis, { partBelow, completed, meshes });

// SPDX-License-Identifier: Apache-2.0
//
// Loads /pack.lw.glb, draws it when all has come, and disposes of it, as often as it is asked to.
import { Color, PerspectiveCamera, Scene, Sphere, WebGLRenderer } from 'three';
import { LightwellLoader } from '../../../web/src/three/index.js';

const renderer = new WebGLRenderer();
const scene = new Scene();
const camera = new PerspectiveCamera();
scene.background = new Color('grey');

/** What the renderer holds while the pack is `shown`, and when it is `gone`; how many meshes and images the pack streams. */
export async function showOnce(): Promise<object> {
  const pack = await new LightwellLoader().setRenderer(renderer).loadAsync('pack.lw.glb');
  const { center, radius } = pack.bounds.getBoundingSphere(new Sphere());
  camera.position.set(center.x, center.y, center.z + 3 * radius);
  scene.add(pack);
  await new Promise<void>((resolve) => pack.addEventListener('complete', () => resolve()));
  renderer.shadowMap.enabled = true;
  renderer.render(scene, camera);
  const shown = { ...renderer.info.memory };
  scene.remove(pack);
  pack.dispose();
  renderer.render(scene, camera);
  const streams = [pack.opening.primitives.size, pack.opening.images.size];
  return { streams, shown, gone: { ...renderer.info.memory, programs: renderer.info.programs!.length } };
}

Object.assign(globalThis, { showOnce });

// SPDX-License-Identifier: Apache-2.0
//
// Loads /pack.lw.glb, looks out from the middle of it each time that its geometry grows, and counts what is seen of the background.
import { Color, type Mesh, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { LightwellLoader } from '../../../web/src/three/index.js';

const SIZE = 128;
const renderer = new WebGLRenderer();
renderer.setSize(SIZE, SIZE);
const scene = new Scene();
scene.background = new Color(1, 0, 1);
const pack = await new LightwellLoader().setRenderer(renderer).loadAsync('pack.lw.glb');
scene.add(pack);

/** In six directions, which see all around. */
function background(): number {
  const camera = new PerspectiveCamera(90, 1, 0.01, 100);
  const pixels = new Uint8Array(4 * SIZE * SIZE);
  let seen = 0;
  for (const direction of [[1, 0, 0], [-1, 0, 0], [0, 0.999, 0.01], [0, -0.999, 0.01], [0, 0, 1], [0, 0, -1]] as const) {
    camera.lookAt(...direction);
    renderer.render(scene, camera);
    const gl = renderer.getContext();
    gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    for (let i = 0; i < pixels.length; i += 4) if (pixels[i]! > 250 && pixels[i + 1]! < 5 && pixels[i + 2]! > 250) seen++;
  }
  return seen;
}

/** Of each state of the geometry: the faces that each mesh draws, and the pixels of the background. */
const states: { faces: number[]; background: number }[] = [];
function look(): void {
  const faces: number[] = [];
  pack.traverse((object) => {
    const { geometry } = object as Partial<Mesh>;
    if (geometry?.index) faces.push(Math.min(geometry.drawRange.count, geometry.index.count) / 3);
  });
  states.push({ faces, background: background() });
}

look();
pack.addEventListener('geometry', look);
const completed = new Promise<void>((resolve) =>
  pack.addEventListener('complete', () => {
    look();
    resolve();
  }),
);
Object.assign(globalThis, { states, completed, streams: pack.opening.primitives.size });

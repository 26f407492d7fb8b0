// SPDX-License-Identifier: Apache-2.0
//
// Measures the radiance of a pack's objects under a sky that the pack's light holds, with and without the same sky as the
// environment of the scene.
import { Color, FloatType, PerspectiveCamera, PMREMGenerator, Scene, WebGLRenderer, WebGLRenderTarget } from 'three';
import { LightwellLoader } from '../../../web/src/three/index.js';

const SIZE = 64;
const renderer = new WebGLRenderer();
const pack = await new LightwellLoader().setRenderer(renderer).loadAsync('pack.lw.glb');
const scene = new Scene().add(pack);
const camera = new PerspectiveCamera(30, 1, 0.1, 100);
const target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });

function draw(): void {
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
}

/** Radiance in the middle of what stands at x, seen from the front: its mean over a few pixels, red, green and blue. */
export function radiance(x: number, sky: number | null): number[] {
  if (sky === null) scene.environment = null;
  else {
    const dome = new Scene();
    dome.background = new Color(sky, sky, sky);
    scene.environment = new PMREMGenerator(renderer).fromScene(dome).texture;
  }
  camera.position.set(x, 0, 4);
  draw();
  const side = 16;
  const pixels = new Float32Array(4 * side * side);
  renderer.readRenderTargetPixels(target, (SIZE - side) / 2, (SIZE - side) / 2, side, side, pixels);
  const mean = (channel: number) => pixels.reduce((sum, value, i) => (i % 4 === channel ? sum + value : sum), 0) / side ** 2;
  return [0, 1, 2].map(mean);
}

let request = 0;
pack.addEventListener('change', () => {
  cancelAnimationFrame(request);
  request = requestAnimationFrame(draw);
});
pack.addEventListener('complete', () => (document.title = 'complete'));
draw();

Object.assign(globalThis, { radiance });

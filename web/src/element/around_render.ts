// SPDX-License-Identifier: Apache-2.0
import type { Camera, Scene, WebGLRenderer } from 'three';

type Act = (renderer: WebGLRenderer, scene: Scene, camera: Camera) => void;
const NOTHING: Act = () => {};

/** Calls back around each drawing of a scene until the end. Several may, and end in any order; what the page itself has put there is kept. */
export function aroundRender(scene: Scene, end: AbortSignal, { before = NOTHING, after = NOTHING }: { before?: Act; after?: Act }): void {
  const { onBeforeRender, onAfterRender } = scene;
  scene.onBeforeRender = (renderer, of, camera, ...rest) => {
    onBeforeRender.call(scene, renderer, of, camera, ...rest);
    if (!end.aborted) before(renderer, scene, camera);
  };
  scene.onAfterRender = (renderer, of, camera, ...rest) => {
    if (!end.aborted) after(renderer, scene, camera);
    onAfterRender.call(scene, renderer, of, camera, ...rest);
  };
}

// SPDX-License-Identifier: Apache-2.0
import type { WebGLRenderer } from 'three';
import { three } from './kit.js';

/** Draws something beside the picture, in the midst of another drawing or not, and leaves the renderer as it was. */
export function aside(renderer: WebGLRenderer, draw: () => void): void {
  const { autoClear, shadowMap, xr, info } = renderer;
  const target = [renderer.getRenderTarget(), renderer.getActiveCubeFace(), renderer.getActiveMipmapLevel()] as const;
  const clear = [renderer.getClearColor(new three.Color()), renderer.getClearAlpha()] as const;
  const shadows = { autoUpdate: shadowMap.autoUpdate, needsUpdate: shadowMap.needsUpdate };
  const [headset, counting] = [xr.enabled, info.autoReset];
  Object.assign(shadowMap, { autoUpdate: false, needsUpdate: false });
  xr.enabled = info.autoReset = false;
  renderer.autoClear = true;
  renderer.setClearColor(0, 0);
  try {
    draw();
  } finally {
    renderer.setClearColor(...clear);
    renderer.autoClear = autoClear;
    Object.assign(shadowMap, shadows);
    [xr.enabled, info.autoReset] = [headset, counting];
    renderer.setRenderTarget(...target);
  }
}

// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, Camera, Matrix4, Texture, WebGLRenderer } from 'three';
import seenSurface from '../../../../shaders/seen_surface.glsl';
import pass from '../../../../shaders/sky_in_grid.glsl';
import type { LightwellLight } from '../light.js';
import { FullScreen } from './full_screen.js';
import { three } from './kit.js';
import type { ScreenShares } from './screen_shares.js';

/** Which share of the sky's light grids have at every pixel of a view: with that of the sky as a lamp it tells what their cells blur. */
export class SkyInGrids {
  readonly #pass: FullScreen;
  /** Of the grids that are in the sums. */
  #seen: Texture[] = [];

  constructor(screen: BufferGeometry) {
    const names = ['surfaces', 'projection', 'probesSH', 'probesMin', 'probesMax', 'probesResolution', 'place', 'sky', 'channel', 'first'];
    const uniforms = Object.fromEntries(names.map((name) => [name, { value: null }]));
    // For the number three.js would write that of the scene's grids.
    const lookup = three.ShaderChunk.lightprobes_pars_fragment.replaceAll('NUM_LIGHT_PROBE_GRIDS', '2');
    this.#pass = new FullScreen(screen, [seenSurface, lookup, pass].join('\n'), uniforms, { RECIPROCAL_PI: '0.31830988618' });
  }

  /** The view is another, or the sky: what was drawn is no longer true. */
  forget(): void {
    this.#seen = [];
  }

  /**
   * Draws the three shares from `share` on, if they are not there: of grids in pairs, with the sky's own light and without it.
   * `sky`: of each colour its irradiance where nothing hides it, by normals in the camera's space. Says whether it drew.
   */
  draw(renderer: WebGLRenderer, shares: ScreenShares, share: number, camera: Camera, grids: [LightwellLight, LightwellLight][], sky: Matrix4[]): boolean {
    const seen = grids.flatMap((pair) => pair.map(({ newest }) => newest));
    if (seen.length === this.#seen.length && seen.every((texture, i) => texture === this.#seen[i])) return false;
    this.#seen = seen;
    const { autoClear } = renderer;
    renderer.autoClear = false;
    grids.forEach(([{ newest, boundingBox, resolution }, without], grid) => {
      for (let channel = 0; channel < 3; channel++)
        shares.write(renderer, share + channel, this.#pass, {
          probesSH: [newest, without.newest],
          probesMin: [boundingBox.min, boundingBox.min],
          probesMax: [boundingBox.max, boundingBox.max],
          probesResolution: [resolution, resolution],
          place: camera.matrixWorld,
          sky: sky[channel],
          channel,
          first: grid === 0,
        });
    });
    renderer.autoClear = autoClear;
    return true;
  }

  dispose(): void {
    this.#pass.dispose();
  }
}

// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, Camera, Matrix4, WebGLRenderer } from 'three';
import seenSurface from '../../../../shaders/seen_surface.glsl';
import skyInGrid from '../../../../shaders/sky_in_grid.glsl';
import type { LightwellLight } from '../light.js';
import { createScreen, FullScreen } from './full_screen.js';
import { three } from './kit.js';
import type { ScreenShares } from './screen_shares.js';

/** In pairs: with the sky's own light and without it. */
type Grids = [LightwellLight, LightwellLight][];

const texelsOf = (grids: Grids) => grids.flatMap((pair) => pair.map(({ newest }) => newest.image.data));

/** Which share of the sky's light grids have at every pixel of a view: with that of the sky as a lamp it tells what their cells blur. */
export class SkyInGrids {
  readonly #screen: BufferGeometry = createScreen();
  readonly #pass: FullScreen;
  /** The texels of the grids that were drawn. */
  #drawn: unknown[] = [];

  constructor() {
    const names = ['surfaces', 'projection', 'probesSH', 'probesMin', 'probesMax', 'probesResolution', 'place', 'sky', 'first'];
    const uniforms = Object.fromEntries(names.map((name) => [name, { value: null }]));
    // For the number three.js would write that of the scene's grids.
    const lookup = three.ShaderChunk.lightprobes_pars_fragment.replaceAll('NUM_LIGHT_PROBE_GRIDS', '2');
    this.#pass = new FullScreen(this.#screen, [seenSurface, lookup, skyInGrid].join('\n'), uniforms, { RECIPROCAL_PI: '0.31830988618' });
  }

  /** The view is another, or the sky: what was drawn is no longer true. */
  forget(): void {
    this.#drawn = [];
  }

  /** Whether the shares of grids are ready as these are now. */
  has(grids: Grids): boolean {
    const texels = texelsOf(grids);
    return texels.length === this.#drawn.length && texels.every((of, i) => of === this.#drawn[i]);
  }

  /**
   * Makes the shares of grids ready. `sky`: of each colour its irradiance where nothing hides it, as the grids have it, by normals in the camera's space.
   */
  draw(renderer: WebGLRenderer, shares: ScreenShares, camera: Camera, grids: Grids, sky: Matrix4[]): void {
    this.#drawn = texelsOf(grids);
    const { autoClear } = renderer;
    renderer.autoClear = false;
    grids.forEach(([{ newest, boundingBox, resolution }, without], i) => {
      this.#pass.draw(renderer, shares.ready, {
        ...shares.seen,
        probesSH: [newest, without.newest],
        probesMin: [boundingBox.min, boundingBox.min],
        probesMax: [boundingBox.max, boundingBox.max],
        probesResolution: [resolution, resolution],
        place: camera.matrixWorld,
        sky,
        first: i === 0,
      });
    });
    renderer.autoClear = autoClear;
  }

  dispose(): void {
    this.#pass.dispose();
    this.#screen.dispose();
  }
}

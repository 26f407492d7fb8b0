// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, Camera, Object3D, WebGLRenderer, WebGLRenderTarget } from 'three';
import permitted from '../../../../shaders/permitted_difference.glsl';
import seenSurface from '../../../../shaders/seen_surface.glsl';
import steps from '../../../../shaders/shadow_steps.glsl';
import { createScreen, FullScreen } from './full_screen.js';
import { three } from './kit.js';
import { textForPasses } from './lights_chunks.js';
import type { ScreenShares } from './screen_shares.js';
import type { Surfaces } from './surfaces.js';

const TILES = [32, 18] as const;
/** Of the picture of colours beside that of the shares. */
const SHARPNESS = 0.5;

/**
 * How far what is shown of a lamp is off, as a visitor sees it: the largest step of the encoded picture that the second half of the samples
 * makes, in steps that are just not seen (docs/light.md section 7).
 */
export class ShadowSteps {
  readonly #screen: BufferGeometry = createScreen();
  readonly #pass: FullScreen;
  readonly #tiles: WebGLRenderTarget;
  readonly #colours: WebGLRenderTarget;
  #coloursStale = true;

  constructor() {
    const names = ['surfaces', 'projection', 'picture', 'sums', 'colours', 'share', 'exposure', 'tiles'];
    const uniforms = Object.fromEntries(names.map((name) => [name, { value: null }]));
    const texts = [textForPasses(), three.ShaderChunk.colorspace_pars_fragment, seenSurface, permitted, steps];
    this.#pass = new FullScreen(this.#screen, texts.join('\n'), uniforms);
    const nearest = { minFilter: three.NearestFilter, magFilter: three.NearestFilter };
    this.#tiles = new three.WebGLRenderTarget(...TILES, { ...nearest, type: three.FloatType, depthBuffer: false });
    this.#colours = new three.WebGLRenderTarget(1, 1, nearest);
  }

  /** What is seen is another. */
  forget(): void {
    this.#coloursStale = true;
  }

  /**
   * Compares the sums of a share, or of one for each of three colours, with what is shown, and tells what it found once the GPU has; `exposure`: by which light
   * is multiplied before it is shown.
   */
  async measure(renderer: WebGLRenderer, shares: ScreenShares, share: number, colours: number, exposure: number): Promise<number> {
    const [tiles, sums] = [new three.Vector2(...TILES), shares.sumsOf(share, colours)];
    const picture = shares.picture.texture;
    this.#pass.draw(renderer, this.#tiles, { ...shares.seen, picture, sums, colours: this.#colours.texture, share, exposure, tiles });
    const found = new Float32Array(4 * TILES[0] * TILES[1]);
    await renderer.readRenderTargetPixelsAsync(this.#tiles, 0, 0, ...TILES, found);
    // Where nothing was written nothing is known.
    const steps = Array.from({ length: TILES[0] * TILES[1] }, (_, i) => (found[4 * i + 3] === 1 ? found[4 * i]! : Infinity));
    return Math.max(...steps);
  }

  /** Draws the colours of what is seen, unless they are. */
  see(surfaces: Surfaces, root: Object3D, camera: Camera, { width, height }: ScreenShares): void {
    if (!this.#coloursStale) return;
    this.#coloursStale = false;
    this.#colours.setSize(Math.ceil(SHARPNESS * width), Math.ceil(SHARPNESS * height));
    surfaces.renderer.setRenderTarget(this.#colours);
    surfaces.draw(root, 'colours', (render) => render(camera));
  }

  dispose(): void {
    for (const part of [this.#pass, this.#tiles, this.#colours, this.#screen]) part.dispose();
  }
}

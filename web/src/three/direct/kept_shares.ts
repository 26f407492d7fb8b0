// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, WebGLRenderer, WebGLRenderTarget } from 'three';
import shader from '../../../../shaders/kept_share.glsl';
import { FullScreen } from './full_screen.js';
import { three } from './kit.js';

/** Shares of a picture as sums again, to which those of other lamps can be shown beside. */
export class KeptShares {
  readonly #pass: FullScreen;

  constructor(screen: BufferGeometry) {
    this.#pass = new FullScreen(screen, shader, { picture: { value: null }, start: { value: null }, which: { value: 0 } });
  }

  /** Writes a lamp's sums; `place` is that of its share in a picture with so many beside one another, each `sums.width` wide. */
  draw(renderer: WebGLRenderer, sums: WebGLRenderTarget, picture: WebGLRenderTarget, place: number, beside: number): void {
    const start = new three.Vector2(Math.floor(place / beside) * sums.width, 1);
    this.#pass.draw(renderer, sums, { picture: picture.texture, start, which: place % beside });
  }

  dispose(): void {
    this.#pass.dispose();
  }
}

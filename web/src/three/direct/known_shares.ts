// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, Matrix4, WebGLRenderer, WebGLRenderTarget } from 'three';
import { COPY, createScreen, FullScreen } from './full_screen.js';
import { three } from './kit.js';
import type { ScreenShares } from './screen_shares.js';

/**
 * What a view that was left knew of lamps' shares: its picture, in which the present view finds again what both see (shaders/shadow_shares.glsl).
 * So a camera that moves keeps its shadows, whatever its meshes are (docs/decisions/048-shadows-known-from-the-view-before.md).
 */
export class KnownShares {
  readonly #picture: WebGLRenderTarget;
  readonly #view: Matrix4 = new three.Matrix4();
  readonly #projection: Matrix4 = new three.Matrix4();
  readonly #screen: BufferGeometry = createScreen();
  readonly #copy: FullScreen;
  /** Of each share, on how many points of its lamp what is known of it rests; 0 where nothing is. */
  #points: number[] = [];

  constructor() {
    const texels = { type: three.FloatType, minFilter: three.NearestFilter, magFilter: three.NearestFilter, depthBuffer: false };
    this.#picture = new three.WebGLRenderTarget(1, 1, texels);
    this.#copy = new FullScreen(this.#screen, COPY, { copied: { value: null } });
  }

  /** Keeps what a view shows that is about to be left; `points` of each share. */
  keep(renderer: WebGLRenderer, left: ScreenShares, points: number[]): void {
    this.#points = points;
    this.#view.copy(left.view);
    this.#projection.copy(left.projection);
    this.#picture.setSize(left.picture.width, left.picture.height);
    this.#copy.draw(renderer, this.#picture, { copied: left.picture.texture });
  }

  /** On how many points of its lamp a share rests. */
  pointsOf(share: number): number {
    return this.#points[share] ?? 0;
  }

  /** What is known is no longer quite true: it counts as so many points, at most. */
  cap(points: number): void {
    this.#points = this.#points.map((of) => Math.min(of, points));
  }

  /** A share is another now. */
  forget(share: number): void {
    this.#points[share] = 0;
  }

  forgetAll(): void {
    this.#points = [];
    this.#picture.dispose();
  }

  /** What shaders/shadow_shares.glsl reads of it in a view. */
  from(view: Matrix4): Record<string, unknown> {
    const toKnown = this.#view.clone().multiply(view.clone().invert());
    return { known: this.#picture.texture, toKnown, knownProjection: this.#projection };
  }

  dispose(): void {
    for (const part of [this.#picture, this.#copy, this.#screen]) part.dispose();
  }
}

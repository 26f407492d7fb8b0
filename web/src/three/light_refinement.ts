// SPDX-License-Identifier: Apache-2.0
import { Box3, type Data3DTexture, Vector3, type WebGLRenderer } from 'three';
import type { LightEvent } from '../core/protocol.js';
import { atlasTexture, type LightAtlas, type LightwellLight } from './light.js';
import type { Refinement } from './refinement.js';
import { RowSweep } from './row_sweep.js';
import type { UploadBudget } from './upload_budget.js';

const TEXEL_BYTES = 8;

/**
 * A light grid that grows finer as a whole. One texture is shown while a newer state goes to another, over as many frames as
 * it takes; then they change places. So a frame never shows a grid between two states.
 */
export class LightRefinement implements Refinement {
  readonly #light: LightwellLight;
  readonly #renderer: WebGLRenderer;
  readonly #sweep: RowSweep;
  #hidden: Data3DTexture;
  /** The state that is on its way to the hidden texture. */
  #current: Data3DTexture | null = null;
  #waiting: Data3DTexture | null = null;
  #consumed = 0;

  /** `light` has the state of the first frame, in a size that `checkSize` lets pass. `received`: its states came as they are. */
  constructor(light: LightwellLight, renderer: WebGLRenderer, private readonly received = true) {
    this.#light = light;
    this.#renderer = renderer;
    this.#hidden = atlasTexture(atlasOf(light.newest), light);
    const { width, height, depth } = light.newest.image;
    this.#sweep = new RowSweep(width * TEXEL_BYTES, height, depth);
    for (const texture of [light.newest, this.#hidden]) renderer.initTexture(texture);
  }

  get pending(): boolean {
    return this.#current !== null || this.#waiting !== null;
  }

  /** A newer state takes the place of one that has not begun to be handed over. Throws when it is of another size. */
  receive(event: LightEvent): void {
    const { width, height, depth } = this.#light.newest.image;
    if (event.width !== width || event.height !== height || event.depth !== depth)
      throw new Error(`the light of stream ${this.#light.definition.stream} has another size than before`);
    const state = atlasTexture(event, this.#light);
    if (this.#waiting !== null) this.#consumed += texelsOf(this.#waiting).byteLength;
    this.#waiting = state;
  }

  advance(budget: UploadBudget): boolean {
    this.#current ??= this.#begin();
    if (this.#current === null) return false;
    const { width } = this.#current.image;
    for (let strip = this.#sweep.take(budget); strip !== null; strip = this.#sweep.take(budget)) {
      const { slice, row, rows } = strip;
      const piece = new Box3(new Vector3(0, row, slice), new Vector3(width, row + rows, slice + 1));
      this.#renderer.copyTextureToTexture(this.#current, this.#hidden, piece, piece.min);
    }
    if (this.#sweep.done) this.#show(this.#current);
    return this.#current === null;
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return this.received ? bytes : 0;
  }

  restart(): void {
    this.#sweep.restart();
  }

  dispose(): void {
    this.#hidden.dispose();
    this.#light.dispose();
  }

  #begin(): Data3DTexture | null {
    const state = this.#waiting;
    this.#waiting = null;
    if (state !== null) this.#sweep.restart();
    return state;
  }

  /** Swaps the textures. Each keeps its texels in memory, since the GPU may lose them. */
  #show(state: Data3DTexture): void {
    const shown = this.#hidden;
    this.#hidden = this.#light.newest;
    this.#light.newest = shown;
    shown.image.data = state.image.data;
    this.#consumed += texelsOf(state).byteLength;
    this.#current = null;
  }
}

function texelsOf(texture: Data3DTexture): Uint16Array<ArrayBuffer> {
  return texture.image.data as Uint16Array<ArrayBuffer>;
}

function atlasOf(texture: Data3DTexture): LightAtlas {
  const { width, height, depth } = texture.image;
  return { atlas: texelsOf(texture), width, height, depth };
}

/** Throws when the GPU's 3D textures cannot be of this one's size. */
export function checkSize({ image }: Data3DTexture, renderer: WebGLRenderer): void {
  const { width, height, depth } = image;
  const gl = renderer.getContext() as WebGL2RenderingContext;
  const most = gl.getParameter(gl.MAX_3D_TEXTURE_SIZE) as number;
  if (Math.max(width, height, depth) > most)
    throw new Error(`the light grid needs a 3D texture of ${width} x ${height} x ${depth}; this GPU holds ${most} at most`);
}

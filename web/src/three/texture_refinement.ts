// SPDX-License-Identifier: Apache-2.0
import { Box2, Texture, Vector2, type WebGLRenderer } from 'three';
import type { TextureEvent } from '../core/protocol.js';
import { messageOf } from './pack_error.js';
import type { Refinement } from './refinement.js';
import { RowSweep } from './row_sweep.js';
import type { UploadBudget } from './upload_budget.js';

export interface ImageSize {
  width: number;
  height: number;
}

/** As GLTFLoader reads images: no conversion of any kind. */
const BITMAP_OPTIONS: ImageBitmapOptions = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };

/**
 * A texture that has its final size from the start, first filled with its enlarged preview. When the image has come, it
 * replaces the preview strip by strip; the mip levels follow with the last one.
 */
export class TextureRefinement implements Refinement {
  readonly #textures: Texture[];
  readonly #stated: ImageSize;
  readonly #renderer: WebGLRenderer;
  readonly #width: number;
  readonly #height: number;
  readonly #sweep: RowSweep;
  #image: ImageBitmap | null = null;
  #decoding = false;
  #bytes = 0;
  #consumed = 0;
  #disposed = false;

  private constructor(textures: Texture[], stated: ImageSize, width: number, height: number, renderer: WebGLRenderer) {
    this.#textures = textures;
    this.#stated = stated;
    this.#width = width;
    this.#height = height;
    this.#renderer = renderer;
    this.#sweep = new RowSweep(4 * width * textures.length, height);
  }

  /** Enlarges the preview of the textures, which share one image, and gives it to the GPU. `stated` is the size of the file. */
  static async create(textures: Texture[], stated: ImageSize, renderer: WebGLRenderer) {
    const { width, height } = stated;
    const shrink = Math.min(1, renderer.capabilities.maxTextureSize / Math.max(width, height));
    const refinement = new TextureRefinement(textures, stated, Math.ceil(width * shrink), Math.ceil(height * shrink), renderer);
    const preview = await refinement.#bitmap(textures[0]!.image as ImageBitmap);
    for (const texture of textures) {
      texture.image = preview;
      texture.needsUpdate = true;
      renderer.initTexture(texture);
    }
    return refinement;
  }

  get pending(): boolean {
    return this.#decoding || (this.#image !== null && !this.#sweep.done);
  }

  /** Decodes the image. When the browser cannot read it, the preview stays and the promise is rejected. */
  async receive(event: TextureEvent): Promise<void> {
    this.#decoding = true;
    try {
      const { width, height } = this.#stated;
      if (event.width !== width || event.height !== height) throw new Error('it has another size than the pack states');
      const image = await this.#bitmap(new Blob([event.file], { type: event.mimeType }));
      if (this.#disposed) return image.close();
      this.#image = image;
      this.#bytes = event.file.byteLength;
    } catch (error) {
      this.#consumed += event.file.byteLength;
      throw new Error(`the image of asset ${event.asset} (${event.mimeType}) cannot be read: ${messageOf(error)}`);
    } finally {
      this.#decoding = false;
    }
  }

  advance(budget: UploadBudget): boolean {
    const strip = this.#image === null ? null : this.#sweep.take(budget);
    if (strip === null) return false;
    const area = new Box2(new Vector2(0, strip.row), new Vector2(this.#width, strip.row + strip.rows));
    for (const texture of this.#textures) {
      texture.mipmapsAutoUpdate = this.#sweep.done;
      this.#renderer.copyTextureToTexture(new Texture(this.#image), texture, area, area.min);
      texture.mipmapsAutoUpdate = true;
    }
    if (this.#sweep.done) this.#finish();
    return this.#sweep.done;
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return bytes;
  }

  restart(): void {
    if (this.pending) this.#sweep.restart();
  }

  dispose(): void {
    this.#disposed = true;
    this.#image?.close();
    for (const texture of this.#textures) texture.dispose();
  }

  /** Keeps the image in memory, since the GPU may lose it. */
  #finish(): void {
    (this.#textures[0]!.image as ImageBitmap).close();
    for (const texture of this.#textures) texture.image = this.#image;
    this.#consumed += this.#bytes;
  }

  #bitmap(source: ImageBitmapSource): Promise<ImageBitmap> {
    const size = { resizeWidth: this.#width, resizeHeight: this.#height, resizeQuality: 'high' } as const;
    return createImageBitmap(source, { ...BITMAP_OPTIONS, ...size });
  }
}

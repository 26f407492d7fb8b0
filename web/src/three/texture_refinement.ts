// SPDX-License-Identifier: Apache-2.0
import { Box2, Texture, Vector2, type WebGLRenderer } from 'three';
import type { TextureEvent } from '../core/protocol.js';
import type { Refinement } from './refinement.js';
import type { UploadBudget } from './upload_budget.js';

/** As GLTFLoader reads images: no conversion of any kind. */
const BITMAP_OPTIONS: ImageBitmapOptions = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };

/**
 * A texture that has its final size from the start, first filled with its enlarged preview. When the image has come, it
 * replaces the preview strip by strip; the mip levels follow with the last one.
 */
export class TextureRefinement implements Refinement {
  readonly #textures: Texture[];
  readonly #renderer: WebGLRenderer;
  readonly #width: number;
  readonly #height: number;
  #image: ImageBitmap | null = null;
  #decoding = false;
  #bytes = 0;
  #row = 0;
  #consumed = 0;
  #disposed = false;

  private constructor(textures: Texture[], width: number, height: number, renderer: WebGLRenderer) {
    this.#textures = textures;
    this.#width = width;
    this.#height = height;
    this.#renderer = renderer;
  }

  /** Enlarges the preview of the textures, which share one image, and gives it to the GPU. Sizes are those of the file. */
  static async create(textures: Texture[], width: number, height: number, renderer: WebGLRenderer) {
    const shrink = Math.min(1, renderer.capabilities.maxTextureSize / Math.max(width, height));
    const refinement = new TextureRefinement(textures, Math.ceil(width * shrink), Math.ceil(height * shrink), renderer);
    const preview = await refinement.#bitmap(textures[0]!.image as ImageBitmap);
    for (const texture of textures) {
      texture.image = preview;
      texture.needsUpdate = true;
      renderer.initTexture(texture);
    }
    return refinement;
  }

  get pending(): boolean {
    return this.#decoding || (this.#image !== null && this.#row < this.#height);
  }

  /** Decodes the image. The preview stays when the browser cannot read it. */
  async receive(event: TextureEvent): Promise<void> {
    this.#decoding = true;
    const image = await this.#bitmap(new Blob([event.file], { type: event.mimeType })).catch(() => null);
    this.#decoding = false;
    if (this.#disposed) return image?.close();
    if (image === null) this.#consumed += event.file.byteLength;
    this.#image = image;
    this.#bytes = event.file.byteLength;
  }

  advance(budget: UploadBudget): boolean {
    if (this.#image === null || !this.pending) return false;
    const rowBytes = 4 * this.#width * this.#textures.length;
    const rows = Math.min(this.#height - this.#row, Math.max(1, Math.floor(budget.left / rowBytes)));
    if (!budget.take(rows * rowBytes)) return false;
    const last = this.#row + rows === this.#height;
    const strip = new Box2(new Vector2(0, this.#row), new Vector2(this.#width, this.#row + rows));
    for (const texture of this.#textures) {
      texture.mipmapsAutoUpdate = last;
      this.#renderer.copyTextureToTexture(new Texture(this.#image), texture, strip, strip.min);
      texture.mipmapsAutoUpdate = true;
    }
    this.#row += rows;
    if (last) this.#finish();
    return true;
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return bytes;
  }

  restart(): void {
    if (this.pending) this.#row = 0;
  }

  dispose(): void {
    this.#disposed = true;
    this.#image?.close();
    for (const texture of this.#textures) texture.dispose();
  }

  /** Keeps the image for the day on which the GPU loses it. */
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

// SPDX-License-Identifier: Apache-2.0
import { Box2, LinearFilter, NearestMipmapNearestFilter, Texture, Vector2, type WebGLRenderer } from 'three';
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
 * A texture that has its final size from the start, first filled with its enlarged preview. What comes goes strip by strip to the mip level of its
 * size; with the last strip the coarser levels are made of that one, and it is the finest that is shown. Last comes the image itself, level 0.
 */
export class TextureRefinement implements Refinement {
  readonly #textures: Texture[];
  readonly #stated: ImageSize;
  readonly #renderer: WebGLRenderer;
  readonly #width: number;
  readonly #height: number;
  #sweep: RowSweep | null = null;
  #image: ImageBitmap | null = null;
  /** Of the image. */
  #level = Infinity;
  #decoding = 0;
  #bytes = 0;
  #consumed = 0;
  #disposed = false;

  private constructor(textures: Texture[], stated: ImageSize, width: number, height: number, renderer: WebGLRenderer) {
    this.#textures = textures;
    this.#stated = stated;
    this.#width = width;
    this.#height = height;
    this.#renderer = renderer;
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
    return this.#decoding > 0 || this.#sweep?.done === false;
  }

  /** Decodes an image. When the browser cannot read it, what was there stays and the promise is rejected. */
  async receive(event: TextureEvent): Promise<void> {
    this.#decoding++;
    try {
      const { width, height } = this.#stated;
      const level = Math.round(Math.log2(Math.max(width, height) / Math.max(event.width, event.height)));
      // Levels are rounded to whole texels.
      const fits = (side: number, of: number) => Math.abs(side - of / 2 ** level) < (level > 0 ? 2 : 1);
      if (!(level >= 0 && fits(event.width, width) && fits(event.height, height))) throw new Error('it has another size than the pack states');
      const image = await this.#bitmap(new Blob([event.file], { type: event.mimeType }), level);
      if (this.#disposed || level > this.#level) {
        this.#consumed += event.file.byteLength;
        return image.close();
      }
      this.#take(image, level, event.file.byteLength);
    } catch (error) {
      this.#consumed += event.file.byteLength;
      throw new Error(`the image of asset ${event.asset} (${event.mimeType}) cannot be read: ${messageOf(error)}`);
    } finally {
      this.#decoding--;
    }
  }

  /** In the place of a coarser one, which is kept until then, since the GPU may lose it. */
  #take(image: ImageBitmap, level: number, bytes: number): void {
    this.#image?.close();
    this.#consumed += this.#bytes;
    this.#image = image;
    this.#level = level;
    this.#bytes = bytes;
    this.#sweep = new RowSweep(4 * image.width * this.#textures.length, image.height);
  }

  advance(budget: UploadBudget): boolean {
    const strip = this.#sweep?.take(budget) ?? null;
    if (strip === null) return false;
    const { done } = this.#sweep!;
    const area = new Box2(new Vector2(0, strip.row), new Vector2(this.#image!.width, strip.row + strip.rows));
    for (const texture of this.#textures) {
      // One without mip levels waits for the image itself.
      if (this.#level > 0 && !hasLevels(texture)) continue;
      texture.mipmapsAutoUpdate = false;
      this.#renderer.copyTextureToTexture(new Texture(this.#image), texture, area, area.min, 0, this.#level);
      texture.mipmapsAutoUpdate = true;
      if (done) this.#showFrom(texture);
    }
    if (done) this.#finish();
    return done;
  }

  /** Makes the image's level the finest that is shown, and all coarser ones of it. */
  #showFrom(texture: Texture): void {
    const gl = this.#renderer.getContext();
    const { __webglTexture } = this.#renderer.properties.get(texture) as { __webglTexture: WebGLTexture };
    this.#renderer.state.bindTexture(gl.TEXTURE_2D, __webglTexture);
    gl.texParameteri(gl.TEXTURE_2D, (gl as WebGL2RenderingContext).TEXTURE_BASE_LEVEL, this.#level);
    if (hasLevels(texture)) gl.generateMipmap(gl.TEXTURE_2D);
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return bytes;
  }

  restart(): void {
    if (this.pending || this.#level > 0) this.#sweep?.restart();
  }

  dispose(): void {
    this.#disposed = true;
    this.#image?.close();
    for (const texture of this.#textures) texture.dispose();
  }

  /** The textures keep the image itself, since the GPU may lose it. */
  #finish(): void {
    this.#consumed += this.#bytes;
    this.#bytes = 0;
    if (this.#level > 0) return;
    (this.#textures[0]!.image as ImageBitmap).close();
    for (const texture of this.#textures) texture.image = this.#image;
  }

  #bitmap(source: ImageBitmapSource, level = 0): Promise<ImageBitmap> {
    const [resizeWidth, resizeHeight] = [this.#width, this.#height].map((side) => Math.max(1, side >> level)) as [number, number];
    return createImageBitmap(source, { ...BITMAP_OPTIONS, resizeWidth, resizeHeight, resizeQuality: 'high' });
  }
}

/** Whether its minification takes mip levels, which are there then. */
const hasLevels = ({ generateMipmaps, minFilter }: Texture) => generateMipmaps && minFilter >= NearestMipmapNearestFilter && minFilter !== LinearFilter;

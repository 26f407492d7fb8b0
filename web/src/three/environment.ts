// SPDX-License-Identifier: Apache-2.0
import type { DataTexture } from 'three';
import type { TextureEvent } from '../core/protocol.js';
import type { EnvironmentDefinition } from './extensions.js';
import { toHalf } from './half.js';
import type { Surroundings } from './opening.js';
import type { Refinement } from './refinement.js';
import type { UploadBudget } from './upload_budget.js';

/** What is taken of three.js. */
export type EnvironmentKit = Pick<
  typeof import('three'),
  'DataTexture' | 'EquirectangularReflectionMapping' | 'HalfFloatType' | 'LinearFilter' | 'RepeatWrapping'
>;

const CHANNELS = 4;
const ONE = toHalf(1);

/**
 * The picture of what surrounds a pack's scene, as three.js takes it for `scene.environment` and `scene.background`: first the preview
 * of the opening, then what the stream brings. Fetched for such packs only: it imports nothing that others have (docs/decisions/008-size-of-the-page.md).
 */
export class Environment implements Refinement {
  readonly texture: DataTexture;
  readonly #radianceOf: Uint16Array;
  readonly #canvas = document.createElement('canvas');
  #image: ImageBitmap | null = null;
  #decoding = false;
  #bytes = 0;
  #consumed = 0;

  constructor(kit: EnvironmentKit, { definition, preview, width, height }: Surroundings) {
    this.#radianceOf = halvesOf(definition);
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.texture = new kit.DataTexture(new Uint16Array(CHANNELS * width * height), width, height);
    this.texture.type = kit.HalfFloatType;
    this.texture.mapping = kit.EquirectangularReflectionMapping;
    this.texture.wrapS = kit.RepeatWrapping;
    this.texture.minFilter = this.texture.magFilter = kit.LinearFilter;
    this.#show(preview);
  }

  get pending(): boolean {
    return this.#decoding || this.#image !== null;
  }

  /** Decodes the picture. When the browser cannot read it, the preview stays and the promise is rejected. */
  async receive({ file, mimeType, asset }: TextureEvent): Promise<void> {
    this.#decoding = true;
    try {
      this.#image = await createImageBitmap(new Blob([file], { type: mimeType }), { colorSpaceConversion: 'none' });
      this.#bytes = file.byteLength;
    } catch (error) {
      this.#consumed += file.byteLength;
      throw new Error(`the environment of asset ${asset} (${mimeType}) cannot be read`, { cause: error });
    } finally {
      this.#decoding = false;
    }
  }

  /** At most 1 MB, at once. */
  advance(budget: UploadBudget): boolean {
    const image = this.#image;
    if (image === null || !budget.take(this.#radianceOf.byteLength)) return false;
    this.#image = null;
    this.#consumed += this.#bytes;
    this.#show(image);
    image.close();
    return true;
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return bytes;
  }

  /** Nothing is handed over in parts. */
  restart(): void {}

  dispose(): void {
    this.#image?.close();
    this.texture.dispose();
  }

  /** Where Lightwell's pictures have their middle, -z, three.js's have their first quarter, and rows from below. */
  #show(image: ImageBitmap): void {
    const { width, height } = this.#canvas;
    const context = this.#canvas.getContext('2d', { willReadFrequently: true })!;
    context.drawImage(image, 0, 0, width, height);
    const { data } = context.getImageData(0, 0, width, height);
    const halves = this.texture.image.data as Uint16Array;
    for (let y = 0; y < height; y++)
      for (let x = 0; x < width; x++) {
        const from = CHANNELS * ((height - 1 - y) * width + ((x + (width >> 2)) % width));
        const to = CHANNELS * (y * width + x);
        for (let c = 0; c < 3; c++) halves[to + c] = this.#radianceOf[data[from + c]!]!;
        halves[to + 3] = ONE;
      }
    // Else three.js would go on to show what it has made of the preview.
    this.texture.dispose();
    this.texture.needsUpdate = true;
  }
}

/** The radiance of each byte, as a half float. */
function halvesOf({ radiance, stops }: EnvironmentDefinition): Uint16Array {
  return Uint16Array.from({ length: 256 }, (_, byte) => toHalf(radiance * 2 ** (stops * (byte / 255 - 1))));
}

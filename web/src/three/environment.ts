// SPDX-License-Identifier: Apache-2.0
import type {
  DataTexture,
  EquirectangularReflectionMapping,
  HalfFloatType,
  LinearFilter,
  RepeatWrapping,
  Scene,
  Texture,
} from 'three';
import type { GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import type { TextureEvent } from '../core/protocol.js';
import type { EnvironmentDefinition, ProgressiveTextureExtension } from './extensions.js';
import { toHalf } from './half.js';
import type { Refinement } from './refinement.js';
import type { UploadBudget } from './upload_budget.js';

// Of three.js, whose types say whether the numbers are right.
const EQUIRECTANGULAR: typeof EquirectangularReflectionMapping = 303;
const REPEAT: typeof RepeatWrapping = 1000;
const LINEAR: typeof LinearFilter = 1006;
const HALF_FLOAT: typeof HalfFloatType = 1016;

/** Of a blurred one, as three.js counts: shapes are gone, colours left. */
const BLUR = 0.3;
/** Of a picture that is taken from the stream: those of the baker have an eighth. Memory is taken before it comes, on the word of the pack. */
const MOST_PIXELS = 2 ** 20;
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
  #scene: Scene | null = null;
  #image: ImageBitmap | null = null;
  #decoding = false;
  #bytes = 0;
  #consumed = 0;

  private constructor(
    Picture: typeof DataTexture,
    definition: EnvironmentDefinition,
    preview: ImageBitmap,
    { width, height }: { width: number; height: number },
    /** Of the picture's stream; -1 where the preview is all that is shown. */
    readonly asset: number,
  ) {
    this.#radianceOf = halvesOf(definition);
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.texture = new Picture(new Uint16Array(CHANNELS * width * height), width, height);
    this.texture.type = HALF_FLOAT;
    this.texture.mapping = EQUIRECTANGULAR;
    this.texture.wrapS = REPEAT;
    this.texture.minFilter = this.texture.magFilter = LINEAR;
    this.#show(preview);
  }

  /** Reads the preview, which the loader has not, since no material shows it. */
  static async create(Picture: typeof DataTexture, definition: EnvironmentDefinition, parser: GLTFParser): Promise<Environment> {
    const preview = ((await parser.getDependency('texture', definition.texture)) as Texture).image as ImageBitmap;
    const { textures } = parser.json as { textures: { extensions?: Record<string, unknown> }[] };
    const stated = textures[definition.texture]!.extensions?.['LIGHTWELL_progressive_texture'] as ProgressiveTextureExtension | undefined;
    const streamed = stated !== undefined && stated.width * stated.height <= MOST_PIXELS;
    return new Environment(Picture, definition, preview, streamed ? stated : preview, streamed ? stated.stream : -1);
  }

  /**
   * Shows it behind a scene, sharp by default, and lets the scene mirror it, which is right where the grid's light is seen: that says how
   * much of it is hidden. What somebody else has put around the scene stays; dispose() takes away what was put.
   */
  putAround(scene: Scene, background: string | null, mirrored: boolean): void {
    const { texture } = this;
    this.#scene = scene;
    scene.environment = replaced(scene.environment, texture, mirrored);
    scene.background = replaced(scene.background, texture, background !== 'none');
    if (scene.background === texture) scene.backgroundBlurriness = background === 'blurred' ? BLUR : 0;
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

  /** All at once: a megabyte for the baker's pictures, which a frame that hands over nothing else lets through. */
  advance(budget: UploadBudget): boolean {
    const image = this.#image;
    if (image === null || !budget.take((this.texture.image.data as Uint16Array).byteLength)) return false;
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
    if (this.#scene !== null) this.putAround(this.#scene, 'none', false);
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

/** What stands in a place after this texture was put there, or taken away. */
function replaced<Other>(before: Other | null, texture: DataTexture, present: boolean): Other | DataTexture | null {
  if (before !== null && before !== (texture as unknown)) return before;
  return present ? texture : null;
}

/** The radiance of each byte, as a half float. */
function halvesOf({ radiance, stops }: EnvironmentDefinition): Uint16Array {
  return Uint16Array.from({ length: 256 }, (_, byte) => (byte === 0 ? 0 : toHalf(radiance * 2 ** (stops * (byte / 255 - 1)))));
}

// SPDX-License-Identifier: Apache-2.0
import { Box3, Data3DTexture, Vector3, type WebGLRenderer } from 'three';
import type { LightEvent } from '../core/protocol.js';
import { type LightwellLight, markContents, SUB_VOLUMES } from './light.js';
import type { Refinement } from './refinement.js';
import { BYTES_PER_FRAME, type UploadBudget } from './upload_budget.js';

const TEXEL_BYTES = 8;

/** Rows y ... y + rows of all nodes of a layer. */
interface Band {
  y: number;
  rows: number;
  z: number;
}

/**
 * A light grid that grows brighter and finer in place. A new state is handed over in bands; a band is all that a layer's rows
 * hold, in all seven sub-volumes, in one frame: a mixture of an old and a new state of one node would flash.
 */
export class LightRefinement implements Refinement {
  readonly #light: LightwellLight;
  readonly #renderer: WebGLRenderer;
  readonly #bands: Band[];
  #current: Data3DTexture | null = null;
  #waiting: Uint16Array<ArrayBuffer> | null = null;
  #next = 0;
  #consumed = 0;

  /** `first` is a state that is there from the first frame on. */
  constructor(light: LightwellLight, renderer: WebGLRenderer, first?: LightEvent) {
    this.#light = light;
    this.#renderer = renderer;
    this.#bands = bandsOf(light.definition.nodes);
    if (first !== undefined) {
      light.setAtlas(this.#atlasOf(first));
      this.#consumed = first.atlas.byteLength;
    }
    renderer.initTexture(light.texture);
  }

  get pending(): boolean {
    return this.#current !== null || this.#waiting !== null;
  }

  /** A newer state takes the place of one that has not begun to be handed over. */
  receive(event: LightEvent): void {
    this.#consumed += this.#waiting?.byteLength ?? 0;
    this.#waiting = markContents(this.#atlasOf(event), this.#light.definition);
  }

  advance(budget: UploadBudget): boolean {
    this.#current ??= this.#begin();
    if (this.#current === null) return false;
    let changed = false;
    for (; this.#next < this.#bands.length; this.#next++) {
      const pieces = this.#pieces(this.#bands[this.#next]!);
      if (!budget.take(pieces.reduce((sum, piece) => sum + bytesOf(piece), 0))) return changed;
      for (const piece of pieces) this.#renderer.copyTextureToTexture(this.#current, this.#light.texture, piece, piece.min);
      changed = true;
    }
    this.#finish(this.#current);
    return true;
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return bytes;
  }

  restart(): void {
    this.#next = 0;
  }

  dispose(): void {
    this.#light.dispose();
  }

  #atlasOf(event: LightEvent): LightEvent['atlas'] {
    if (event.atlas.length !== (this.#light.texture.image.data as Uint16Array).length)
      throw new Error(`the light of stream ${event.stream} has another size than its grid`);
    return event.atlas;
  }

  #begin(): Data3DTexture | null {
    if (this.#waiting === null) return null;
    const { width, height, depth } = this.#light.texture.image;
    const state = new Data3DTexture(this.#waiting, width, height, depth);
    this.#waiting = null;
    this.#next = 0;
    return state;
  }

  /** Keeps the state for the day on which the GPU loses it. */
  #finish(state: Data3DTexture): void {
    this.#light.texture.image.data = state.image.data;
    this.#consumed += (state.image.data as Uint16Array).byteLength;
    this.#current = null;
  }

  /** The texels of a band in each sub-volume, and in the padding where the layer is the first or the last. */
  #pieces({ y, rows, z }: Band): Box3[] {
    const [width, , layers] = this.#light.definition.nodes;
    const slices = [z + 1];
    if (z === 0) slices.push(0);
    if (z === layers - 1) slices.push(layers + 1);
    const subVolumes = Array.from({ length: SUB_VOLUMES }, (_, i) => i * (layers + 2));
    return subVolumes.flatMap((first) =>
      slices.map((slice) => new Box3(new Vector3(0, y, first + slice), new Vector3(width, y + rows, first + slice + 1))),
    );
  }
}

function bandsOf([width, height, layers]: [number, number, number]): Band[] {
  const rowBytes = 2 * SUB_VOLUMES * width * TEXEL_BYTES;
  const rows = Math.max(1, Math.min(height, Math.floor(BYTES_PER_FRAME / rowBytes)));
  const bands: Band[] = [];
  for (let z = 0; z < layers; z++) for (let y = 0; y < height; y += rows) bands.push({ y, rows: Math.min(rows, height - y), z });
  return bands;
}

function bytesOf(piece: Box3): number {
  const size = piece.getSize(new Vector3());
  return size.x * size.y * size.z * TEXEL_BYTES;
}

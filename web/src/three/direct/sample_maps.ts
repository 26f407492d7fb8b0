// SPDX-License-Identifier: Apache-2.0
import type { WebGLRenderer } from 'three';
import type { LampDefinition } from '../extensions.js';
import { ShadowMap } from './shadow_map.js';

/** Sides of the maps, in texels: of a cube's faces, and of a sun's picture; no two kinds have the same. */
const CUBE_SIZE = 512;
const SUN_SIZE = 2048;
/** Of the sky's pictures, whose edges none of so many shows. */
const SKY_SIZE = 1024;
/** Of more lamps than this the maps that are kept are half as fine. */
const FEW_LAMPS = 4;

/** Whether the light comes from far away: the shadow is one picture, not a cube. */
const hasPicture = ({ kind }: LampDefinition) => kind === 'sun' || kind === 'sky';

const sizeOf = ({ kind }: LampDefinition) => (kind === 'sun' ? SUN_SIZE : kind === 'sky' ? SKY_SIZE : CUBE_SIZE);

/** The map from a lamp's middle, one of so many lamps. */
export const middleMap = (definition: LampDefinition, lamps: number) =>
  new ShadowMap(hasPicture(definition), sizeOf(definition) / (lamps > FEW_LAMPS ? 2 : 1));

/** The maps that samples are drawn into, one after another: one for all lamps of a kind. */
export class SampleMaps {
  readonly #maps = new Map<number, ShadowMap>();

  /** Takes the memory of a new one at once, so that no later frame waits for that. */
  of(definition: LampDefinition, renderer: WebGLRenderer): ShadowMap {
    const size = sizeOf(definition);
    const map = this.#maps.get(size) ?? new ShadowMap(hasPicture(definition), size);
    if (!this.#maps.has(size)) map.allocate(renderer);
    this.#maps.set(size, map);
    return map;
  }

  /** Gives the memory back. */
  dispose(): void {
    for (const map of this.#maps.values()) map.dispose();
    this.#maps.clear();
  }
}

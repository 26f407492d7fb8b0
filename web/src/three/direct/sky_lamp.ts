// SPDX-License-Identifier: Apache-2.0
import type { Box3, DataTexture, Matrix4, Object3D } from 'three';
import type { LampDefinition } from '../extensions.js';
import type { LightwellLight } from '../light.js';
import type { Opening } from '../opening.js';
import { three } from './kit.js';
import { TEXELS_OF_SKY } from './lamp.js';
import { type LampPoint, skyPointOf } from './lamp_points.js';
import { Sky } from './sky.js';

/** Where a pack's sky is. */
export interface SkyOfPack {
  readonly opening: Opening;
  /** The picture of its surroundings, where it has one. */
  readonly environment: { readonly texture: DataTexture } | undefined;
  /** Those that are made to be shown in the place of others, too. */
  readonly grids: LightwellLight[];
  /** What the pack is about, in its space. */
  readonly focus: Box3;
}

/** The sky of a pack as one of its lamps, in the place of its light in the grids. */
export class SkyLamp {
  #sky: Sky | null = null;
  /** Of the picture that the sky was made of. */
  #version = -1;

  /** `pack`: an object that stands and turns as the pack does. */
  constructor(
    private readonly of: SkyOfPack,
    private readonly pack: Object3D,
  ) {}

  /** As which the sky is among the lamps of a pack that has its light apart, and tells what it is: around what its shadows are drawn of. */
  static of({ opening, environment, grids, focus }: SkyOfPack): LampDefinition[] {
    if (!grids.some(({ definition }) => definition.insteadOf) || !Sky.isKnown(opening, environment?.texture)) return [];
    const { center, radius } = focus.getBoundingSphere(new three.Sphere());
    return [{ kind: 'sky', radiance: [1, 1, 1], center: center.toArray(), range: radius }];
  }

  /** Whether one of the grids is seen in whose place it shines. */
  get replacesSomething(): boolean {
    return this.replaced.some(([grid]) => grid.visible);
  }

  /** The grids that are shown, and those that may be in their place: of each pair the first, and the second. */
  get replaced(): [LightwellLight, LightwellLight][] {
    const { grids } = this.of;
    return grids.flatMap((grid) =>
      grids.filter(({ definition }) => definition === grid.definition.insteadOf).map((other): [LightwellLight, LightwellLight] => [other, grid]),
    );
  }

  /** Takes the sky as its picture is now, which gets sharper; says whether it is another than before. */
  renew(): boolean {
    const { opening, environment } = this.of;
    const version = environment?.texture.version ?? 0;
    if (this.#sky !== null && version === this.#version) return false;
    this.#sky = Sky.of(opening, environment?.texture);
    this.#version = version;
    return true;
  }

  /** Lets the grids have its light, or not where it is shown as a lamp. */
  replaceInGrids(shown: boolean): void {
    for (const [grid, other] of this.replaced) grid.shown = shown ? other : grid;
  }

  /** Of a number from 0 on; after `renew`. */
  pointOf(index: number): LampPoint {
    return skyPointOf(this.#sky!, this.#turn(), index);
  }

  /** The texels of its irradiance in the table of shaders/direct_light.glsl, by normals in a camera's space; after `renew`. */
  texels(view: Matrix4): number[] {
    if (this.#sky === null) return new Array(4 * TEXELS_OF_SKY).fill(0);
    return this.irradiance(view).flatMap((matrix) => matrix.toArray());
  }

  /** Of each colour, times a factor, the irradiance where nothing hides it, by normals in a camera's space (Sky); after `renew`. */
  irradiance(view: Matrix4, factors: readonly number[] = [1, 1, 1]): Matrix4[] {
    const turn = new three.Matrix4().extractRotation(view).multiply(this.#turn());
    const back = turn.clone().transpose();
    return this.#sky!.irradiance.map((matrix, c) => turn.clone().multiply(matrix).multiply(back).multiplyScalar(factors[c]!));
  }

  /** From the pack's axes into the world's. */
  #turn(): Matrix4 {
    return new three.Matrix4().extractRotation(this.pack.matrixWorld);
  }
}

// SPDX-License-Identifier: Apache-2.0
import type { Camera, DataTexture, Vector3 } from 'three';
import { three } from './kit.js';
import { type Lamp, placed, TEXELS_OF_LAMP, TEXELS_OF_SKY, texelsOf } from './lamp.js';
import type { ScreenShares } from './screen_shares.js';

const TEXELS_OF_HEAD = 2;

/** What materials read of the lamps themselves: row 0 of the map in shaders/direct_light.glsl. */
export class LampTable {
  readonly texture: DataTexture;

  constructor(lamps: number) {
    const width = TEXELS_OF_HEAD + TEXELS_OF_LAMP * lamps + TEXELS_OF_SKY;
    this.texture = new three.DataTexture(new Float32Array(4 * width), width, 1, undefined, three.FloatType);
  }

  get width(): number {
    return this.texture.image.width;
  }

  /** Writes the lamps that are shown, each beside the number of its share, as a camera sees them; `sky`: the texels of its irradiance. */
  write(camera: Camera, shown: [Lamp, number][], shadowed: boolean, { width, height, viewport }: ScreenShares, sky: number[]): void {
    const view = camera.matrixWorldInverse;
    const space = {
      point: (of: Vector3) => of.clone().applyMatrix4(view),
      direction: (of: Vector3) => of.clone().applyMatrix4(view).sub(new three.Vector3().setFromMatrixPosition(view)),
    };
    const data = this.texture.image.data as Float32Array;
    const now = new Float32Array(data.length);
    const texels = shown.flatMap(([lamp, share]) => texelsOf(placed(lamp), space, share));
    now.set([shown.length, Number(shadowed), width, height, ...viewport.toArray(), ...sky, ...texels]);
    if (now.every((number, i) => number === data[i])) return;
    data.set(now);
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
  }
}

// SPDX-License-Identifier: Apache-2.0
//
// The lamp of the peers: three.js's lights at random places of it, as all their examples have them. A red light casts shadows and a green one
// at the same place does not: red over green is the share that arrives, whatever else a method makes of the light.
import * as THREE from 'three';

/** Texels of a map. Of a spot light's 90 degrees it has as many as a face of Lightwell's cubes. */
const SIZE = 1024;
const ANGLE = Math.atan(2);
const NEAR = 0.2;
const FAR = 12;
/** Half the width of what directional lights light, metres. */
const REACH = 3;
/** Of the depth, and along the normal in metres: the least that show no stripes. */
const BIAS = { spot: [-2e-4, 0.01], directional: [-5e-4, 0.01] };

/** Mulberry32 (T. Ettinger 2017). */
export function randomFrom(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

export class JitteredLamp {
  /** `kind`: 'spot', or 'directional' as in the peers' examples. */
  constructor(lamp, kind, seed) {
    this.lamp = lamp;
    this.random = randomFrom(seed);
    this.lights = [[1, 0, 0], [0, 1, 0]].map((color, i) => {
      const light = kind === 'spot' ? new THREE.SpotLight(0, 100, 0, ANGLE, 0, 2) : new THREE.DirectionalLight(0, 1);
      light.color.setRGB(...color, THREE.LinearSRGBColorSpace);
      light.castShadow = i === 0;
      light.shadow.mapSize.set(SIZE, SIZE);
      [light.shadow.bias, light.shadow.normalBias] = BIAS[kind];
      Object.assign(light.shadow.camera, { left: -REACH, right: REACH, top: REACH, bottom: -REACH, near: NEAR, far: FAR });
      light.shadow.camera.updateProjectionMatrix();
      return light;
    });
    this.directional = kind === 'directional';
    this.moveTo(0, 0);
  }

  /** To the next random place. */
  jitter() {
    this.moveTo(2 * this.random() - 1, 2 * this.random() - 1);
  }

  /** A spot looks straight from the lamp; a directional light looks at what lies below the lamp's middle. */
  moveTo(s, t) {
    const { center, u, v, normal } = this.lamp;
    const place = center.map((c, i) => c + s * u[i] + t * v[i]);
    const below = this.directional ? center.map((c, i) => c + center[1] * normal[i]) : place.map((c, i) => c + normal[i]);
    for (const { position, target } of this.lights) {
      position.set(...place);
      target.position.set(...below);
      target.updateMatrixWorld();
    }
  }
}

/** Red over green of pictures, 0 where nothing is lit. */
export const sharesOf = (pixels) => Array.from({ length: pixels.length / 4 }, (_, i) => (pixels[4 * i + 1] > 0 ? pixels[4 * i] / pixels[4 * i + 1] : 0));

// SPDX-License-Identifier: Apache-2.0
import type { Light, Vector3 } from 'three';
import type { LampDefinition } from '../extensions.js';
import { three } from './kit.js';

/**
 * A lamp of a pack, as LIGHTWELL_lamps describes it. It may be moved, turned, hidden, and given another `color` or `intensity`, whose
 * product is its radiance or intensity. A sky stands and turns with its pack: its color and intensity multiply its light, and where it is hidden the
 * grids have its light.
 */
export type Lamp = Light & { readonly definition: LampDefinition };

/** In the order of shaders/direct_light.glsl. */
const KINDS = ['rectangle', 'disc', 'sphere', 'point', 'spot', 'sun', 'sky'] as const;

/** A lamp's form in the world. */
export interface PlacedLamp {
  readonly lamp: Lamp;
  readonly kind: number;
  readonly position: Vector3;
  readonly u: Vector3;
  readonly v: Vector3;
  /** Where a rectangle or disc faces, a spot points or a sun's light goes. */
  readonly normal: Vector3;
  readonly radius: number;
  readonly scale: number;
}

export function createLamp(definition: LampDefinition): Lamp {
  const { center, group, radiance, intensity } = definition;
  const [r, g, b] = radiance ?? intensity ?? [0, 0, 0];
  const strongest = Math.max(r, g, b, 1e-9);
  const light = new three.Light(undefined, strongest);
  light.color.setRGB(r / strongest, g / strongest, b / strongest, three.LinearSRGBColorSpace);
  light.position.set(...(center ?? [0, 0, 0]));
  light.userData.group = group;
  return Object.assign(light, { definition });
}

/** Where a lamp is after the last update of the world's matrices. */
export function placed(lamp: Lamp): PlacedLamp {
  const { definition, matrixWorld } = lamp;
  const turned = (of: [number, number, number] = [0, 0, 0]) => {
    const way = new three.Vector3(...of);
    return way.applyMatrix4(matrixWorld).sub(new three.Vector3().setFromMatrixPosition(matrixWorld));
  };
  const scale = Math.cbrt(Math.abs(matrixWorld.determinant()));
  return {
    lamp,
    kind: KINDS.indexOf(definition.kind),
    position: new three.Vector3().setFromMatrixPosition(matrixWorld),
    u: turned(definition.u),
    v: turned(definition.v),
    normal: turned(definition.normal ?? [0, -1, 0]).normalize(),
    radius: scale * (definition.radius ?? 0),
    scale,
  };
}

/** From the world into a camera's space. */
export interface CameraSpace {
  point(of: Vector3): Vector3;
  direction(of: Vector3): Vector3;
}

/** Numbers that change when a lamp is moved: its shadows do, too. */
export function formOf({ position, u, v, normal, radius }: PlacedLamp): number[] {
  return [position, u, v, normal].flatMap((vector) => vector.toArray()).concat(radius);
}

/** Of a lamp in the table of shaders/direct_light.glsl, and of a sky's irradiance. */
export const TEXELS_OF_LAMP = 5;
export const TEXELS_OF_SKY = 12;

/** The texels of a lamp in the table of shaders/direct_light.glsl. */
export function texelsOf(placed: PlacedLamp, view: CameraSpace, share: number): number[] {
  const { lamp, kind, scale, normal } = placed;
  const { definition } = lamp;
  const { innerConeAngle = 0, outerConeAngle = Math.PI / 4, range = 0, twoSided } = definition;
  const isPoint = definition.kind === 'point' || definition.kind === 'spot';
  const strength = lamp.intensity * (isPoint ? scale * scale : 1);
  const isSpot = definition.kind === 'spot';
  const position = definition.kind === 'sun' ? view.direction(normal.clone().negate()) : view.point(placed.position);
  return [
    ...[...position.toArray(), kind],
    ...[...lamp.color.toArray().map((channel) => channel * strength), range * scale],
    ...[...view.direction(placed.u).toArray(), isSpot ? Math.cos(outerConeAngle) : placed.radius],
    ...[...view.direction(placed.v).toArray(), isSpot ? Math.cos(innerConeAngle) : Number(twoSided ?? false)],
    ...[...view.direction(normal).toArray(), share],
  ];
}

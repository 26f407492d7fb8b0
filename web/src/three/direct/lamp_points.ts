// SPDX-License-Identifier: Apache-2.0
import type { Vector3 } from 'three';
import { three } from './kit.js';
import type { PlacedLamp } from './lamp.js';

/** A point of a lamp, from which a shadow map is drawn. */
export interface LampPoint {
  readonly position: Vector3;
  /** Of the lamp's surface there; 0 where it shines evenly to all sides. */
  readonly normal: Vector3;
  readonly bothSides: boolean;
  /** The map's axes, the last one to its front. */
  readonly axes: readonly [Vector3, Vector3, Vector3];
}

/** Steps of the sequence R2 and of the golden ratio (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). */
const STEP_U = 0.7548776662466927;
const STEP_V = 0.5698402909980532;
const STEP_TURN = 0.6180339887498949;
/** A map is turned by up to so much from sample to sample, in radians: its texels fall elsewhere. */
const TILT = 0.05;

const fraction = (x: number) => x - Math.floor(x);

/**
 * The point of a number from 0 on: a progressive sequence, any beginning of which covers the lamp evenly. The first one is the middle.
 * All lamps have the same sequence: their shadows are never mixed, so that nothing has to tell them apart.
 */
export function pointOf(placed: PlacedLamp, index: number): LampPoint {
  const a = fraction(0.5 + index * STEP_U);
  const b = fraction(0.5 + index * STEP_V);
  const { definition } = placed.lamp;
  const position = placed.position.clone();
  const normal = new three.Vector3();
  if (definition.kind === 'rectangle') {
    position.addScaledVector(placed.u, 2 * a - 1).addScaledVector(placed.v, 2 * b - 1);
    normal.copy(placed.normal);
  } else if (definition.kind === 'sphere' && index > 0) {
    const z = 1 - 2 * a;
    const [across, turn] = [Math.sqrt(1 - z * z), 2 * Math.PI * b];
    normal.set(across * Math.cos(turn), across * Math.sin(turn), z);
    position.addScaledVector(normal, placed.radius);
  }
  return { position, normal, bothSides: definition.twoSided === true, axes: axesOf(placed.normal, index, a, b) };
}

/** Axes to the front, turned and tilted a little from sample to sample. */
function axesOf(front: Vector3, index: number, a: number, b: number): [Vector3, Vector3, Vector3] {
  const turn = 2 * Math.PI * fraction(index * STEP_TURN);
  const aside = new three.Vector3(...(Math.abs(front.x) < 0.5 ? [1, 0, 0] : [0, 1, 0]) as [number, number, number]);
  const x = aside.cross(front).normalize();
  const y = new three.Vector3().crossVectors(front, x);
  const z = front.clone().addScaledVector(x, TILT * (a - 0.5)).addScaledVector(y, TILT * (b - 0.5)).normalize();
  const right = x.clone().multiplyScalar(Math.cos(turn)).addScaledVector(y, Math.sin(turn));
  right.addScaledVector(z, -right.dot(z)).normalize();
  return [right, new three.Vector3().crossVectors(z, right), z];
}

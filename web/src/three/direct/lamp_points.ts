// SPDX-License-Identifier: Apache-2.0
import type { Matrix4, Vector3 } from 'three';
import { three } from './kit.js';
import type { PlacedLamp } from './lamp.js';
import type { Sky } from './sky.js';

/** A point of a lamp, from which a shadow map is drawn. */
export interface LampPoint {
  readonly position: Vector3;
  /** Of what it adds to the sums, where each colour has its own. */
  readonly color?: readonly [number, number, number];
  /** Of the lamp's surface there; 0 where it shines evenly to all sides. */
  readonly normal: Vector3;
  readonly bothSides: boolean;
  /** The map's axes, the last one to its front. */
  readonly axes: readonly [Vector3, Vector3, Vector3];
}

/** From sample to sample a map is turned by the golden ratio of a whole turn ... */
const STEP_TURN = 0.6180339887498949;
/** ... and tilted by up to so much, in radians: its texels fall elsewhere. */
const TILT = 0.05;
/** Moves the sequence so that any 4, 16, 64 or 256 of its first points have their mean near the middle. */
const SHIFT = 0x55555555;

/** The point in whose shadow a lamp stands until there are samples. */
export function middleOf(placed: PlacedLamp): LampPoint {
  return { position: placed.position, normal: new three.Vector3(), bothSides: true, axes: axesOf(placed.normal, 0, 0, 0) };
}

/**
 * The point of a number from 0 on: a progressive sequence (Sobol's of two dimensions, moved by a digital shift), any beginning of which
 * covers the lamp evenly. All lamps have the same sequence: their shadows are never mixed, so that nothing has to tell them apart.
 */
export function pointOf(placed: PlacedLamp, index: number): LampPoint {
  const [a, b] = squareOf(index);
  const { definition } = placed.lamp;
  const position = placed.position.clone();
  const normal = new three.Vector3();
  if (definition.kind === 'rectangle') {
    position.addScaledVector(placed.u, 2 * a - 1).addScaledVector(placed.v, 2 * b - 1);
    normal.copy(placed.normal);
  } else if (definition.kind === 'disc') {
    const [x, y] = discOf(2 * a - 1, 2 * b - 1);
    const [right, up] = axesOf(placed.normal, 0, 0, 0);
    position.addScaledVector(right, x * placed.radius).addScaledVector(up, y * placed.radius);
    normal.copy(placed.normal);
  } else if (definition.kind === 'sphere') {
    const z = 1 - 2 * a;
    const [across, turn] = [Math.sqrt(1 - z * z), 2 * Math.PI * b];
    normal.set(across * Math.cos(turn), across * Math.sin(turn), z);
    position.addScaledVector(normal, placed.radius);
  }
  const tilt = definition.kind === 'sun' ? 0 : TILT;
  const axes = axesOf(placed.normal, index, tilt * (a - 0.5), tilt * (b - 0.5));
  return { position, normal, bothSides: definition.twoSided === true, axes };
}

/** The direction of a number from 0 on, from which a picture of the sky's light is drawn; `turn` is the pack's. */
export function skyPointOf(sky: Sky, turn: Matrix4, index: number): LampPoint {
  const { direction, color } = sky.sampleOf(...squareOf(index));
  const front = direction.negate().applyMatrix4(turn);
  return { position: new three.Vector3(), color, normal: new three.Vector3(), bothSides: true, axes: axesOf(front, index, 0, 0) };
}

/** Takes a square round the origin to a disc so that areas keep their ratios (P. Shirley, K. Chiu, A Low Distortion Map Between Disk and Square, 1997). */
function discOf(x: number, y: number): [number, number] {
  if (x === 0 && y === 0) return [0, 0];
  const isWide = Math.abs(x) > Math.abs(y);
  const angle = (Math.PI / 4) * (isWide ? y / x : 2 - x / y);
  const radius = isWide ? x : y;
  return [radius * Math.cos(angle), radius * Math.sin(angle)];
}

/** The point of a number in the unit square. */
function squareOf(index: number): [number, number] {
  return [((radicalInverse(index) ^ SHIFT) >>> 0) / 2 ** 32, ((sobol(index) ^ SHIFT) >>> 0) / 2 ** 32];
}

/** The bits of a whole number, the lowest first, as a fraction of 2^32. */
function radicalInverse(index: number): number {
  let bits = 0;
  for (let bit = 1 << 31, rest = index; rest > 0; rest >>= 1, bit >>>= 1) if (rest & 1) bits |= bit;
  return bits;
}

/** The second dimension of Sobol's sequence. */
function sobol(index: number): number {
  let bits = 0;
  for (let row = 1 << 31, rest = index; rest > 0; rest >>= 1, row ^= row >>> 1) if (rest & 1) bits ^= row;
  return bits;
}

/** Axes to the front, turned from sample to sample and tilted a little. */
function axesOf(front: Vector3, index: number, tiltX: number, tiltY: number): [Vector3, Vector3, Vector3] {
  const turn = 2 * Math.PI * index * STEP_TURN;
  const aside = new three.Vector3(...(Math.abs(front.x) < 0.5 ? [1, 0, 0] : [0, 1, 0]) as [number, number, number]);
  const x = aside.cross(front).normalize();
  const y = new three.Vector3().crossVectors(front, x);
  const z = front.clone().addScaledVector(x, tiltX).addScaledVector(y, tiltY).normalize();
  const right = x.clone().multiplyScalar(Math.cos(turn)).addScaledVector(y, Math.sin(turn));
  right.addScaledVector(z, -right.dot(z)).normalize();
  return [right, new three.Vector3().crossVectors(z, right), z];
}

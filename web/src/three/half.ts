// SPDX-License-Identifier: Apache-2.0

const LARGEST = 65504;
const LEAST_NORMAL = 2 ** -14;
/** Of the fractions of numbers below LEAST_NORMAL. */
const STEP = 2 ** -24;

const float = new Float32Array(1);
const bits = new Uint32Array(float.buffer);
let table: Float32Array | undefined;

/** The value of each half float. */
export function halfValues(): Float32Array {
  table ??= Float32Array.from({ length: 1 << 16 }, (_, half) => valueOf(half));
  return table;
}

function valueOf(half: number): number {
  const exponent = (half >> 10) & 31;
  const fraction = half & 1023;
  const value = exponent === 0 ? fraction * STEP : (1 + fraction / 1024) * 2 ** (exponent - 15);
  return half < 0x8000 ? value : -value;
}

/** The nearest half float; beyond the largest, that one. */
export function toHalf(value: number): number {
  const size = Math.min(Math.abs(value), LARGEST);
  const sign = value < 0 ? 0x8000 : 0;
  if (size < LEAST_NORMAL) return sign | Math.round(size / STEP);
  float[0] = size;
  // The exponent counts from another zero; half of what is cut off rounds.
  return sign | ((bits[0]! - (112 << 23) + 0x1000) >> 13);
}

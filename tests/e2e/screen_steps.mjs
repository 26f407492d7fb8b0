// SPDX-License-Identifier: Apache-2.0

/** As a screen shows it, which reflects a little of the room's light: 1 of 200 cd/m2. */
function encode(light) {
  const x = (Math.min(Math.max(light, 0), 1) + 0.005) / 1.005;
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** By how many of a screen's 255 steps white surfaces of two irradiances are apart. */
export const stepsBetween = (a, b) => 255 * Math.abs(encode(a / Math.PI) - encode(b / Math.PI));

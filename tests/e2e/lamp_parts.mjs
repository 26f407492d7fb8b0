// SPDX-License-Identifier: Apache-2.0
//
// Lamps as many small parts, to sum over: each is [place, normal, area].
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
export const length = (a) => Math.sqrt(dot(a, a));
export const unit = (a) => a.map((x) => x / length(a));

/** Irradiance by the sum over parts of a surface of radiance 1. */
export function summed(parts, place, normal) {
  return parts.reduce((sum, [at, facing, area]) => {
    const way = subtract(at, place);
    const distance = length(way);
    const cosines = Math.max(0, dot(way, normal)) * Math.max(0, -dot(way, facing));
    return sum + (cosines * area) / distance ** 4;
  }, 0);
}

/** Of a rectangle in a plane of one y, which shines down. */
export function partsOfRectangle([x0, x1], y, [z0, z1], steps = 300) {
  const area = ((x1 - x0) * (z1 - z0)) / steps ** 2;
  const along = (a, b, i) => a + ((b - a) * (i + 0.5)) / steps;
  return Array.from({ length: steps ** 2 }, (_, i) => [[along(x0, x1, i % steps), y, along(z0, z1, Math.floor(i / steps))], [0, -1, 0], area]);
}

export function partsOfSphere(center, radius, steps = 400) {
  return Array.from({ length: steps ** 2 }, (_, i) => {
    const z = -1 + (2 * ((i % steps) + 0.5)) / steps;
    const turn = (2 * Math.PI * (Math.floor(i / steps) + 0.5)) / steps;
    const across = Math.sqrt(1 - z * z);
    const facing = [across * Math.cos(turn), across * Math.sin(turn), z];
    return [center.map((c, axis) => c + radius * facing[axis]), facing, (4 * Math.PI * radius ** 2) / steps ** 2];
  });
}

/** Of a disc that shines down. */
export function partsOfDisc([x, y, z], radius, steps = 400) {
  return Array.from({ length: steps ** 2 }, (_, i) => {
    const out = (radius * ((i % steps) + 0.5)) / steps;
    const turn = (2 * Math.PI * (Math.floor(i / steps) + 0.5)) / steps;
    const area = (out * radius * 2 * Math.PI) / steps ** 2;
    return [[x + out * Math.cos(turn), y, z + out * Math.sin(turn)], [0, -1, 0], area];
  });
}

/** A lamp so bright that its penumbra behind the edge of a half-plane at x < 0, y = 1 goes through all of the screen's values on a floor at y = 0. */
export const LAMP_BEHIND_EDGE = { kind: 'rectangle', center: [0, 2, 0], normal: [0, -1, 0], u: [0.5, 0, 0], v: [0, 0, 0.5], radiance: [10, 10, 10] };

/** The irradiance that the floor has of it at x. */
export function irradianceBehindEdge(x) {
  const left = Math.min(0.5, Math.max(-0.5, -x));
  return 10 * summed(partsOfRectangle([left, 0.5], 2, [-0.5, 0.5], 100), [x, 0, 0], [0, 1, 0]);
}

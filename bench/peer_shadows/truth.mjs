// SPDX-License-Identifier: Apache-2.0
//
// What share of a lamp reaches places of surfaces: irradiance by rays, over that of the whole lamp by Lambert's formula.
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { BIN } from '../../tests/e2e/packs.mjs';

/** How far off the surface light is measured, metres. */
const OFF_SURFACE = 1e-4;
const UP = [0, 1, 0];

const subtract = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** Irradiance of a rectangle of radiance 1 on a plane (Lambert 1760): half the sum over its edges of angle times cosine, above the horizon. */
export function irradianceOf({ center, u, v, normal: facing }, place, normal) {
  if (dot(subtract(place, center), facing) <= 0) return 0;
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([s, t]) => subtract(center.map((c, i) => c + s * u[i] + t * v[i]), place));
  const above = corners.flatMap((corner, i) => {
    const next = corners[(i + 1) % 4];
    const [height, after] = [dot(corner, normal), dot(next, normal)];
    const crossing = height * after < 0 ? [corner.map((x, k) => x + (height / (height - after)) * (next[k] - x))] : [];
    return height >= 0 ? [corner, ...crossing] : crossing;
  });
  const sum = above.reduce((total, corner, i) => {
    const [a, b] = [unit(corner), unit(above[(i + 1) % above.length])];
    const axis = cross(a, b);
    const sine = Math.hypot(...axis);
    return sine < 1e-12 ? total : total + (Math.atan2(sine, dot(a, b)) * dot(axis, normal)) / sine;
  }, 0);
  return Math.abs(sum) / 2;
}

/** Shares at places of a floor, and their variance, of so many rays each. */
export function sharesAt(file, lamp, places, rays, folder) {
  const points = join(folder, 'places.csv');
  const row = ([x, y, z]) => [x, y + OFF_SURFACE, z, ...UP].join(',');
  writeFileSync(points, ['x,y,z,nx,ny,nz', ...places.map(row)].join('\n'));
  const options = ['--points', points, '--integrator', 'path', '--quantity', 'direct', '--spp', String(rays), '--quiet'];
  const csv = execFileSync(`${BIN}/lightwell`, ['probe', file, ...options], { encoding: 'utf8', maxBuffer: 1 << 28 });
  const rows = csv.trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
  // The standard error is that of the three colours' mean square.
  const mean = Math.hypot(...lamp.radiance) / Math.sqrt(3);
  return rows.map(([, , , , , , red, , , error], i) => {
    const whole = irradianceOf(lamp, places[i], UP);
    return whole > 0 ? { share: red / (lamp.radiance[0] * whole), variance: (error / (mean * whole)) ** 2 } : { share: 0, variance: 0 };
  });
}

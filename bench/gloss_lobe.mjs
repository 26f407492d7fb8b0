// SPDX-License-Identifier: Apache-2.0
//
// gloss_lobe.mjs: fits the lobe of shaders/direct_light_gloss.glsl to three.js's GGX; prints the polynomial that stands there, and how far the lobe is
// from GGX in percent: half of the integral of the difference of both, each of which has the integral 1, by roughness and angle; in the mean of all that was
// fitted; and in the mean of polynomials of the second degree, and of lobes that are each fitted alone, as by a table without end.
import { pathToFileURL } from 'node:url';

/** A lobe is fitted at so many points a side, twice: drawn as GGX has its facets, and as a cosine has directions. */
const POINTS = 16;
const ROUGHNESSES = [0.045, ...Array.from({ length: 19 }, (_, i) => 0.1 + 0.05 * i)];
/** Of the angle to the viewer: closer to grazing ones, where lobes change most. */
const COSINES = Array.from({ length: 14 }, (_, i) => 0.03 + 0.97 * (i / 13) ** 1.5);
/** Powers of roughness^2 and of what grows towards grazing angles, but for 1: at no roughness the lobe is a mirror's. */
const powersTo = (degree) =>
  Array.from({ length: (degree + 1) ** 2 - 1 }, (_, i) => [Math.floor((i + 1) / (degree + 1)), (i + 1) % (degree + 1)]).filter(([i, j]) => i + j <= degree);
const POWERS = powersTo(3);
/** Errors count in parts of themselves and this, so that lobes that a cosine can be, small angles, become as right as they can. */
const ENOUGH = 0.001;

const length = (a) => Math.hypot(...a);
const scaled = (a, by) => a.map((x) => x * by);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** GGX with Smith's correlated masking, without Fresnel's term, times the cosine: of a surface that faces z, whose viewer is at (sine, 0, cosine). */
export function glossOf(roughness, viewer, to) {
  if (to[2] <= 0) return 0;
  const squared = roughness ** 4;
  const half = to.map((x, i) => x + viewer[i]);
  const facets = squared / (Math.PI * ((half[2] / length(half)) ** 2 * (squared - 1) + 1) ** 2);
  const hidden = (a, b) => a * Math.sqrt(squared + (1 - squared) * b * b);
  return (facets * 0.5 * to[2]) / (hidden(to[2], viewer[2]) + hidden(viewer[2], to[2]));
}

/** A cosine's lobe after the transform of shaders/direct_light_gloss.glsl. */
const lobeAt = ([a, b, e], [x, y, z]) => z / (Math.PI * a * e * (((x - b * z) / a) ** 2 + (y / e) ** 2 + z * z) ** 2);

/** Facets as a viewer sees them (E. Heitz, Sampling the GGX Distribution of Visible Normals, 2018), for a point of the unit square. */
function visibleFacet(alpha, viewer, [u, v]) {
  const seen = scaled([alpha * viewer[0], 0, viewer[2]], 1 / length([alpha * viewer[0], 0, viewer[2]]));
  const across = [0, 1, 0];
  const [x, turn] = [Math.sqrt(u) * Math.cos(2 * Math.PI * v), Math.sqrt(u) * Math.sin(2 * Math.PI * v)];
  const share = 0.5 * (1 + seen[2]);
  const y = (1 - share) * Math.sqrt(1 - x * x) + share * turn;
  const z = Math.sqrt(Math.max(0, 1 - x * x - y * y));
  const up = cross(seen, across);
  const facet = [0, 1, 2].map((i) => x * across[i] + y * up[i] + z * seen[i]);
  const stretched = [alpha * facet[0], alpha * facet[1], Math.max(1e-9, facet[2])];
  return scaled(stretched, 1 / length(stretched));
}

/** Directions, each with GGX's normalised value, and the density with which it is drawn. */
function pointsOf(roughness, cosine, points) {
  const viewer = [Math.sqrt(1 - cosine ** 2), 0, cosine];
  const alpha = roughness ** 2;
  const seen = 1 / (0.5 + 0.5 * Math.sqrt(1 + (alpha * viewer[0] / cosine) ** 2));
  const list = [];
  const add = (to) => {
    if (to[2] <= 1e-9) return;
    const half = to.map((x, i) => x + viewer[i]);
    const facets = alpha ** 2 / (Math.PI * ((half[2] / length(half)) ** 2 * (alpha ** 2 - 1) + 1) ** 2);
    list.push({ to, gloss: glossOf(roughness, viewer, to), density: points ** 2 * ((facets * seen) / (4 * cosine) + to[2] / Math.PI) });
  };
  for (let i = 0; i < points ** 2; i++) {
    const [u, v] = [((i % points) + 0.5) / points, (Math.floor(i / points) + 0.5) / points];
    const facet = visibleFacet(alpha, viewer, [u, v]);
    const twice = 2 * (viewer[0] * facet[0] + viewer[2] * facet[2]);
    add(facet.map((x, k) => twice * x - viewer[k]));
    add([Math.sqrt(u) * Math.cos(2 * Math.PI * v), Math.sqrt(u) * Math.sin(2 * Math.PI * v), Math.sqrt(1 - u)]);
  }
  const all = list.reduce((sum, { gloss, density }) => sum + gloss / density, 0);
  for (const point of list) point.gloss /= all;
  return list;
}

/** What the polynomial is of, at a roughness and a cosine. */
function placeOf(roughness, cosine, { points = POINTS, of = POWERS } = {}) {
  const r = roughness ** 2;
  const height = Math.sqrt(cosine ** 2 + 5 * r * r);
  const powers = of.map(([i, j]) => r ** i * (1 - cosine / height) ** j);
  return { r, lean: Math.sqrt(1 - cosine ** 2) / height, powers, points: pointsOf(roughness, cosine, points) };
}

/** The lobe that factors make at a place. */
function lobeOf({ r, lean }, [x, y, z]) {
  const b = -lean * y;
  return [2 * r * (1 + b * b) * x, b, 2 * r * z];
}

const factorsAt = ({ powers }, fit) => fit.map((of) => of.reduce((sum, x, i) => sum + x * powers[i], 1));

/** Mean square of the difference in parts of the density. */
const errorOf = (lobe, points) => points.reduce((sum, { to, gloss, density }) => sum + (gloss - lobeAt(lobe, to)) ** 2 / density, 0);

const costOf = (places, fit) =>
  places.reduce((sum, place) => sum + Math.log(ENOUGH + errorOf(lobeOf(place, factorsAt(place, fit).map((x) => Math.max(x, 1e-3))), place.points)), 0);

/** Solves a symmetric positive system by Cholesky's decomposition. */
function solve(matrix, right) {
  const l = matrix.map((row) => [...row]);
  const x = [...right];
  const n = x.length;
  for (let i = 0; i < n; i++)
    for (let j = 0; j <= i; j++) {
      let sum = l[i][j];
      for (let k = 0; k < j; k++) sum -= l[i][k] * l[j][k];
      l[i][j] = i === j ? Math.sqrt(sum) : sum / l[j][j];
    }
  for (let i = 0; i < n; i++) x[i] = (x[i] - l[i].slice(0, i).reduce((sum, y, k) => sum + y * x[k], 0)) / l[i][i];
  for (let i = n - 1; i >= 0; i--) {
    for (let k = i + 1; k < n; k++) x[i] -= l[k][i] * x[k];
    x[i] /= l[i][i];
  }
  return x;
}

/** The normal equations of a step from a fit. */
function equationsAt(places, fit) {
  const terms = fit[0].length;
  const n = 3 * terms;
  const matrix = Array.from({ length: n }, () => new Array(n).fill(0));
  const right = new Array(n).fill(0);
  for (const place of places) {
    const factors = factorsAt(place, fit);
    const lobe = lobeOf(place, factors);
    const moved = [0, 1, 2].map((k) => lobeOf(place, factors.map((x, i) => (i === k ? x + STEP : x))));
    const weight = 1 / (ENOUGH + errorOf(lobe, place.points));
    const [inner, outer] = [[0, 1, 2].map(() => [0, 0, 0]), [0, 0, 0]];
    for (const { to, gloss, density } of place.points) {
      const value = lobeAt(lobe, to);
      const slopes = moved.map((other) => (lobeAt(other, to) - value) / STEP);
      for (let k = 0; k < 3; k++) {
        outer[k] += (weight * slopes[k] * (gloss - value)) / density;
        for (let l = 0; l < 3; l++) inner[k][l] += (weight * slopes[k] * slopes[l]) / density;
      }
    }
    for (let i = 0; i < n; i++) {
      const [k, power] = [Math.floor(i / terms), place.powers[i % terms]];
      right[i] += outer[k] * power;
      for (let j = 0; j < n; j++) matrix[i][j] += inner[k][Math.floor(j / terms)] * power * place.powers[j % terms];
    }
  }
  return { matrix, right };
}

const STEP = 1e-4;

const everywhere = (of) => ROUGHNESSES.flatMap((roughness) => COSINES.map((cosine) => placeOf(roughness, cosine, { of })));

/** Fits the lobes of all places at once by Levenberg's and Marquardt's method: for each of the three factors a number for each of the powers. */
export function fitLobe(places = everywhere(POWERS)) {
  let fit = [0, 1, 2].map(() => places[0].powers.map(() => 0));
  let [cost, damping] = [costOf(places, fit), 1e-2];
  for (let gain = Infinity; gain > 1e-6 * places.length; ) {
    const { matrix, right } = equationsAt(places, fit);
    gain = 0;
    for (let trial = 0; trial < 10 && gain === 0; trial++) {
      const damped = matrix.map((row, i) => row.map((x, j) => (i === j ? x * (1 + damping) + 1e-9 : x)));
      const step = solve(damped, right);
      const next = fit.map((of, k) => of.map((x, i) => x + step[k * of.length + i]));
      const better = cost - costOf(places, next);
      if (better > 0) [fit, cost, gain] = [next, cost - better, better];
      damping *= better > 0 ? 0.2 : 5;
    }
  }
  return fit;
}

/** How far a lobe is from GGX, in percent. */
function differenceAt(place, fit) {
  const lobe = lobeOf(place, factorsAt(place, fit));
  return place.points.reduce((sum, { to, gloss, density }) => sum + Math.abs(gloss - lobeAt(lobe, to)) / density, 0) * 50;
}

/** The numbers of a fit as they stand in the shader, power after power. */
export const numbersOf = (fit) => POWERS.map((_, i) => fit.map((of) => Number(of[i].toFixed(4))));

function print(fit) {
  numbersOf(fit).forEach((numbers, i) => console.log(`${POWERS[i]}: vec3( ${numbers.join(', ').replaceAll('-', '- ')} )`));
  const angles = [0, 20, 40, 60, 70, 80, 85];
  console.log(`| roughness | ${angles.join(' | ')} |`);
  for (const roughness of [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1]) {
    const differences = angles.map((angle) => differenceAt(placeOf(roughness, Math.cos((angle * Math.PI) / 180), { points: 64 }), fit).toFixed(1));
    console.log(`| ${roughness} | ${differences.join(' | ')} |`);
  }
  const meanOf = (places, fitOf) => places.reduce((sum, place) => sum + differenceAt(place, fitOf(place)), 0) / places.length;
  const [places, second, alone] = [POWERS, powersTo(2), [[0, 0]]].map(everywhere);
  const ofSecond = fitLobe(second);
  console.log(`in the mean ${meanOf(places, () => fit).toFixed(2)}, of the second degree ${meanOf(second, () => ofSecond).toFixed(2)}`);
  console.log(`each alone ${meanOf(alone, (place) => fitLobe([place])).toFixed(2)}`);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) print(fitLobe());

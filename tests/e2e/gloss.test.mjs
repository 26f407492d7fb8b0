// SPDX-License-Identifier: Apache-2.0
//
// What gloss mirrors of lamps that have an area: lobes that were fitted (bench/gloss_lobe.mjs), against sums over the lamps of what three.js's materials are.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fitLobe, numbersOf } from '../../bench/gloss_lobe.mjs';
import { launch } from './browser.mjs';
import { ROOT } from './dependencies.mjs';
import { dot, length, partsOfDisc, partsOfRectangle, partsOfSphere, subtract, unit } from './lamp_parts.mjs';
import { forAllTests } from './lifetime.mjs';
import { openScript } from './test_page.mjs';

const browser = await forAllTests(launch());

/** GGX without its facets' density: Smith's correlated masking, and Schlick's Fresnel term. */
function maskedOf(roughness, f0, normal, viewer, to) {
  const half = unit(to.map((x, i) => x + viewer[i]));
  const hidden = (a, b) => a * Math.sqrt(roughness ** 4 + (1 - roughness ** 4) * b * b);
  const masked = 0.5 / (hidden(dot(normal, to), dot(normal, viewer)) + hidden(dot(normal, viewer), dot(normal, to)));
  return { half, value: masked * (f0 + (1 - f0) * (1 - dot(viewer, half)) ** 5) };
}

/** What a surface mirrors of light from everywhere: the sum over facets, drawn by their density. */
function allMirrored(roughness, f0, cosine, steps = 200) {
  const [normal, viewer] = [[0, 0, 1], [Math.sqrt(1 - cosine ** 2), 0, cosine]];
  let sum = 0;
  for (let i = 0; i < steps ** 2; i++) {
    const [u, turn] = [((i % steps) + 0.5) / steps, (2 * Math.PI * (Math.floor(i / steps) + 0.5)) / steps];
    const tangent = roughness ** 2 * Math.sqrt(u / (1 - u));
    const facet = unit([tangent * Math.cos(turn), tangent * Math.sin(turn), 1]);
    const seen = dot(viewer, facet);
    const to = facet.map((x, k) => 2 * seen * x - viewer[k]);
    if (seen > 0 && to[2] > 0) sum += (maskedOf(roughness, f0, normal, viewer, to).value * 4 * seen * to[2]) / facet[2];
  }
  return sum / steps ** 2;
}

/** What a surface mirrors of a lamp of radiance 1, as the sum over its parts. */
function lampMirrored(parts, place, normal, viewer, roughness, f0) {
  return parts.reduce((sum, [at, facing, area]) => {
    const way = subtract(at, place);
    const distance = length(way);
    const to = unit(way);
    const cosines = -dot(to, facing) * dot(to, normal);
    if (dot(to, facing) >= 0 || cosines <= 0) return sum;
    const { half, value } = maskedOf(roughness, f0, normal, viewer, to);
    const facets = roughness ** 4 / (Math.PI * (dot(normal, half) ** 2 * (roughness ** 4 - 1) + 1) ** 2);
    return sum + (facets * value * cosines * area) / distance ** 2;
  }, 0);
}

const RECTANGLE = { kind: 'rectangle', center: [0, 1, 0], normal: [0, -1, 0], u: [0.5, 0, 0], v: [0, 0, 0.3], radiance: [1, 1, 1] };
const DISC = { kind: 'disc', center: [0, 1, 0], normal: [0, -1, 0], radius: 0.4, radiance: [1, 1, 1] };
const SPHERE = { kind: 'sphere', center: [0, 1, 0], radius: 0.4, radiance: [1, 1, 1] };
const LAMPS = [
  [RECTANGLE, partsOfRectangle([-0.5, 0.5], 1, [-0.3, 0.3], 160)],
  [DISC, partsOfDisc([0, 1, 0], 0.4, 160)],
  [SPHERE, partsOfSphere([0, 1, 0], 0.4, 220)],
];
const ROUGHNESSES = [0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1];
/** Place, normal, viewer: below the lamp, beside it, where it lies half in the mirrored direction, at a grazing angle, half below the horizon. */
const VIEWS = [
  [[0, 0, 0], [0, 1, 0], [0, 1, 0]],
  [[-0.6, 0, 0], [0, 1, 0], unit([-0.6, 1, 0])],
  [[-0.6, 0, 0.2], [0, 1, 0], unit([-1, 0.9, 0.3])],
  [[-1.5, 0, 0], [0, 1, 0], unit([-1.5, 1, 0])],
  [[-1.5, 0, 0], [0, 1, 0], unit([-1.5, 1, 1])],
  [[-2, 0, 0], [0, 1, 0], unit([-1, 0.2, 0])],
  [[0.9, 0.5, 0], unit([-1, 0.2, 0]), unit([-0.5, 0.1, 0.5])],
];
/**
 * In parts of what the surface would mirror of light from everywhere: a lobe that a cosine has become has that much of its light elsewhere than GGX (at 80
 * degrees and roughness 0.3 it is 17 %, of which a lamp has a part), and three.js's table of all that is mirrored errs by a tenth at roughness 1.
 */
const MOST = 0.07;
/** A quarter of the views' errors are larger than this. */
const MEAN = 0.01;

/** Of dielectrics, metals and clear coats: the material, f0, and whether three.js adds what facets mirror onto one another. */
const MATERIALS = [
  [{ metalness: 0 }, 0.04, true],
  [{ metalness: 1, color: 0xffffff }, 1, true],
  [{ metalness: 0, specularIntensity: 0, clearcoat: 1 }, 0.04, false],
];

test('gloss mirrors of lamps what the sum over them is', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/direct_light.ts');
  await page.waitForFunction(() => globalThis.mirrored);
  const offs = MATERIALS.map(() => []);
  for (const [place, normal, viewer] of VIEWS) {
    const cosine = dot(normal, viewer);
    const all = ROUGHNESSES.map((roughness) => [0, 1].map((f0) => allMirrored(roughness, f0, cosine)));
    for (const [lamp, parts] of LAMPS) {
      const ofLamp = ROUGHNESSES.map((roughness) => [0, 1].map((f0) => lampMirrored(parts, place, normal, viewer, roughness, f0)));
      for (const [m, [material, f0, repeats]] of MATERIALS.entries()) {
        const materials = ROUGHNESSES.map((roughness) => ({ ...material, roughness: material.clearcoat ? 1 : roughness, clearcoatRoughness: roughness }));
        const values = await page.evaluate((of) => mirrored(...of), [lamp, place, normal, viewer, materials]);
        ROUGHNESSES.forEach((roughness, i) => {
          // Both are linear in f0.
          const at = ([none, one]) => none + f0 * (one - none);
          const more = repeats ? 1 + f0 * (1 / all[i][1] - 1) : 1;
          const off = (values[i] / more - at(ofLamp[i])) / at(all[i]);
          offs[m].push(Math.abs(off));
          assert.ok(Math.abs(off) < MOST, `${lamp.kind} from ${place}, f0 ${f0}, roughness ${roughness}: ${values[i]} instead of ${more * at(ofLamp[i])}, off by ${off}`);
        });
      }
    }
  }
  for (const [m, [material]] of MATERIALS.entries()) {
    const mean = offs[m].reduce((sum, x) => sum + x, 0) / offs[m].length;
    t.diagnostic(`${JSON.stringify(material)}: mean ${(100 * mean).toFixed(2)} %, largest ${(100 * Math.max(...offs[m])).toFixed(2)} %`);
    assert.ok(mean < MEAN, `mean ${mean}`);
  }
  assert.deepEqual(errors, []);
});

/** A small sphere and a point of its intensity. */
const SMALL = { ...SPHERE, radius: 0.005 };
const POINT = { kind: 'point', center: [0, 1, 0], intensity: [1, 1, 1].map(() => Math.PI * 0.005 ** 2) };
/** A lobe's density errs by more than its integral over a lamp. */
const MOST_AT_A_POINT = 0.1;

test('materials of all kinds mirror a small sphere as they do a point', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/direct_light.ts');
  await page.waitForFunction(() => globalThis.mirrored);
  const glossy = { roughness: 0.4, metalness: 0 };
  const materials = [
    glossy,
    { ...glossy, sheen: 1, sheenColor: 0x8080ff, sheenRoughness: 0.5 },
    { ...glossy, iridescence: 1, iridescenceIOR: 1.8 },
    { ...glossy, anisotropy: 0.7 },
    { ...glossy, retroreflectivity: 0.5 },
    { ...glossy, clearcoat: 0.5, clearcoatRoughness: 0.3 },
    { ...glossy, metalness: 1, color: 0xffcc88 },
  ];
  for (const viewer of [[0, 1, 0], unit([-0.5, 1, 0]), unit([-0.8, 1, 0.4])]) {
    const [spheres, points] = await Promise.all([SMALL, POINT].map((lamp) => page.evaluate((all) => mirrored(...all), [lamp, [-0.5, 0, 0], [0, 1, 0], viewer, materials])));
    spheres.forEach((value, i) => {
      const off = value / points[i] - 1;
      t.diagnostic(`${viewer.map((x) => x.toFixed(2))} ${JSON.stringify(materials[i])}: ${(100 * off).toFixed(1)} %`);
      assert.ok(points[i] > 0 && Math.abs(off) < MOST_AT_A_POINT, `${JSON.stringify(materials[i])} from ${viewer}: ${value} instead of ${points[i]}`);
    });
  }
  assert.deepEqual(errors, []);
});

test('the shader has the numbers that the fit finds', () => {
  const shader = readFileSync(`${ROOT}shaders/direct_light_gloss.glsl`, 'utf8').replaceAll('- ', '-');
  const found = [...shader.matchAll(/vec3\( (-?\d\.\d+), (-?\d\.\d+), (-?\d\.\d+) \)/g)].map(([, ...numbers]) => numbers.map(Number));
  const fitted = numbersOf(fitLobe());
  // Of rounding, and of another machine's sines.
  fitted.forEach((numbers, i) => numbers.forEach((x, k) => assert.ok(Math.abs(x - found[i][k]) < 2e-3, `${i}: ${found[i]} instead of ${numbers}`)));
});

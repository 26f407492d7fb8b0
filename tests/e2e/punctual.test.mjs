// SPDX-License-Identifier: Apache-2.0
//
// Points and spots of a pack fade on the page as in the bake and in KHR_lights_punctual, others as three.js has them.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { room, writeScene } from './scenes.mjs';
import { openScript } from './test_page.mjs';
import { complete } from './view.mjs';

/** Of floats in a shader, some of which take the difference of cosines that are nearly the same. */
const ROUNDING = 1e-3;
/** CIEDE2000; 1 is just visible. What remains is 8-bit colours, and the noise of `render` where there are several lamps: 1.01 with its 2048 samples. */
const MEAN = 0.5;
const P95 = 1.1;

const folder = temporaryFolder();
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
const browser = await forAllTests(launch());

const near = (actual, expected, what) =>
  assert.ok(Math.abs(actual - expected) <= ROUNDING * Math.max(1, expected), `${what}: ${actual} instead of ${expected}`);

test('irradiance is that of KHR_lights_punctual at a distance and in a penumbra', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/punctual.ts');
  await page.waitForFunction(() => globalThis.ofSpot);
  const lamp = (definition, distance, angle) => page.evaluate((values) => ofLamp(...values), [definition, distance, angle]);
  const window = (distance, range) => Math.max(0, 1 - (distance / range) ** 4) / distance ** 2;
  for (const [distance, range] of [[0.8, 1], [0.5, 1], [0.95, 1], [1.1, 1], [0.05, 2], [1.6, 2]])
    near(await lamp({ range }, distance), window(distance, range), `${distance} m of ${range} m`);
  near((await lamp({ range: 1 }, 0.8)) * 0.8 ** 2, 0.5904, 'what is left at 0.8 of the range');
  near(await lamp({}, 0.9), 1 / 0.81, 'a lamp without end');
  const [innerConeAngle, outerConeAngle] = [0.2, 0.6];
  const spot = { kind: 'spot', innerConeAngle, outerConeAngle };
  const cosineAt = (share) => Math.cos(outerConeAngle) + share * (Math.cos(innerConeAngle) - Math.cos(outerConeAngle));
  for (const share of [0.1, 0.5, 0.9]) near(await lamp(spot, 1, Math.acos(cosineAt(share))), share ** 2, `${share} of the penumbra`);
  near(await lamp(spot, 1, 0.1), 1, 'within the inner cone');
  near(await lamp(spot, 1, 0.61), 0, 'outside of the outer cone');
  near(await lamp({ ...spot, range: 1 }, 0.8, Math.acos(cosineAt(0.5))), 0.25 * window(0.8, 1), 'both');
  near(await lamp({ kind: 'spot', innerConeAngle: 0.5, outerConeAngle: 0.5 }, 1, 0.49), 1, 'a sharp edge, inside');
  assert.deepEqual(errors, []);
});

test('lights of the user’s own beside them fade as three.js has it', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/punctual.ts');
  await page.waitForFunction(() => globalThis.ofSpot);
  await page.evaluate(() => ofLamp({ range: 1 }, 0.8));
  near(await page.evaluate(() => ofPoint(0.8, 1)), 0.5904 ** 2 / 0.64, 'a point');
  const [outer, penumbra] = [0.6, 0.5];
  const half = Math.acos((Math.cos(outer) + Math.cos(outer * (1 - penumbra))) / 2);
  near(await page.evaluate((values) => ofSpot(...values), [half, outer, penumbra]), 0.5, 'a spot');
  assert.deepEqual(errors, []);
});

const spot = (intensity, range, innerConeAngle, outerConeAngle, at) => ({
  lamp: { type: 'spot', intensity, range, spot: { innerConeAngle, outerConeAngle } },
  at,
});
/** Of several `render` chooses one at random for each sample, the noise of which needs many samples. */
const SCENES = {
  'a point': {
    lamps: [{ lamp: { type: 'point', intensity: 0.5, range: 1.6, color: [1, 0.8, 0.6] }, at: [-0.3, 0.3, -0.2] }],
    size: [320, 180],
    samples: 16,
  },
  'a spot': { lamps: [spot(2, 2.2, 0.1, 0.9, [0.2, 0.2, 0.9])], size: [320, 180], samples: 16 },
  'several spots': {
    lamps: [spot(2, 2.2, 0.1, 0.5, [0.4, 0.3, 0.9]), spot(2, 2.4, 0.2, 0.6, [-0.4, 0, 0.9]), spot(1, 2, 0, 0.9, [0, -0.3, 0.8])],
    size: [200, 150],
    samples: 2048,
  },
};

for (const [name, { lamps, size, samples }] of Object.entries(SCENES))
  test(`direct light of ${name} with a range looks as in lightwell render`, async (t) => {
    const material = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.7, 0.7, 0.7, 1] } };
    const scene = writeScene(`${folder}/${name}.gltf`, [{ mesh: room(1), material }], lamps);
    const gltf = JSON.parse(readFileSync(scene, 'utf8'));
    gltf.cameras = [{ type: 'perspective', perspective: { yfov: 1, znear: 0.01 } }];
    gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0, 0.95] }) - 1);
    writeFileSync(scene, JSON.stringify(gltf));
    const pack = bake(scene, `${folder}/${name}.lw.glb`);
    const routes = { query: '?light=direct', '/pack.lw.glb': pack };
    const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/lambert.ts', routes);
    await page.setViewportSize({ width: size[0], height: size[1] });
    await complete(page);
    const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
    writeFileSync(`${folder}/page.png`, Buffer.from(url.split(',')[1], 'base64'));
    const picture = ['--integrator', 'direct', '--tone', 'none', '--size', size.join('x'), '--spp', `${samples}`];
    lightwell('render', pack, '-o', `${folder}/render.png`, ...picture);
    const { mean, p95 } = JSON.parse(lightwell('diff', `${folder}/page.png`, `${folder}/render.png`, '--metric', 'deltae', '--json'));
    assert.ok(mean <= MEAN && p95 <= P95, `mean ${mean}, 95th percentile ${p95}`);
    assert.deepEqual(errors, []);
  });

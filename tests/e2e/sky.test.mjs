// SPDX-License-Identifier: Apache-2.0
//
// A convex object under an even sky of radiance L: every point of a matt one shows albedo * L, of a metal one colour * L.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { CLIENT, scriptPage } from './test_page.mjs';

const SKY = 0.5;
/** Where the spheres stand: so far apart that one takes less than 1 % of the other's sky. */
const MATT = { x: -6, color: [0.6, 0.4, 0.2] };
const METAL = { x: 6, color: [0.9, 0.6, 0.3] };
/**
 * Relative. Noise of the photons and nodes inside the sphere, 5 %; a matt standard material reflects some of the 4 % of
 * its gloss, and a rough metal loses as much.
 */
const TOLERANCE = 0.12;

const folder = temporaryFolder();
const material = ({ color }, metallicFactor) => ({
  pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor, roughnessFactor: metallicFactor === 1 ? 0.2 : 1 },
});
const PACK = bake(
  writeScene(`${folder}/spheres.gltf`, [
    { mesh: sphere(1), material: material(MATT, 0), at: [MATT.x, 0, 0] },
    { mesh: sphere(1), material: material(METAL, 1), at: [METAL.x, 0, 0] },
  ]),
  `${folder}/pack.lw.glb`,
  { environment: `${SKY},${SKY},${SKY}`, photons: 400_000, grid: 24 },
);

const script = await scriptPage('tests/e2e/pages/sky.ts');
const browser = await forAllTests(launch());
const server = await forAllTests(startStaticServer({ ...script, ...CLIENT, '/pack.lw.glb': PACK }));
const { page, errors } = await openPage(browser);
await page.goto(server.url);
await page.waitForFunction(() => document.title === 'complete');

/** Compares what the sphere shows with its colour times the sky. */
async function assertShows({ x, color }, sky) {
  const shown = await page.evaluate(([at, radiance]) => globalThis.radiance(at, radiance), [x, sky]);
  shown.forEach((value, channel) => {
    const expected = color[channel] * SKY;
    assert.ok(Math.abs(value / expected - 1) < TOLERANCE, `${shown}, not ${color.map((part) => part * SKY)}`);
  });
  assert.deepEqual(errors, []);
}

test('a matt object shows the light of the sky', () => assertShows(MATT, null));
test('metal mirrors it', () => assertShows(METAL, null));
test('the sky as the scene’s environment too lights nothing twice', () => assertShows(MATT, SKY));
test('nor do metals mirror it twice', () => assertShows(METAL, SKY));

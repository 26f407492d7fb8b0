// SPDX-License-Identifier: Apache-2.0
//
// The white furnace: under a sky of one radiance all around, what reflects all light cannot be told from what else does, metal or not,
// rough or smooth, at its rim as in its middle.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** What three.js's table and its sum over reflections leave at rims, of 1. */
const LOST = 0.02;
const RADIUS = 0.4;

const white = (metallicFactor, roughnessFactor) => ({ pbrMetallicRoughness: { metallicFactor, roughnessFactor } });
const BALLS = { 'smooth metal': white(1, 0.2), 'rough metal': white(1, 0.7), 'half a metal': white(0.5, 0.5), 'rough dielectric': white(0, 0.9) };

const folder = temporaryFolder();
const browser = await forAllTests(launch());

test('under an even sky what is white looks alike, metal or not', async (t) => {
  const names = Object.keys(BALLS);
  const shapes = names.map((name, i) => ({ mesh: sphere(RADIUS, 32), material: BALLS[name], at: [i - 1.5, 0, 0] }));
  const scene = writeScene(`${folder}/balls.gltf`, shapes, []);
  const gltf = JSON.parse(readFileSync(scene, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: 0.4, znear: 0.1 } }];
  gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0, 6] }) - 1);
  writeFileSync(scene, JSON.stringify(gltf));
  const pack = bake(scene, `${folder}/balls.lw.glb`, { environment: '1,1,1', 'target-error': 4 });
  const element = '<lightwell-view src="pack.lw.glb" tone="none" exposure="-1" style="position: fixed; inset: 0"></lightwell-view>';
  const server = await forTest(t, startStaticServer({ ...(await elementPage(element)), '/pack.lw.glb': pack }));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await complete(page);
  const found = await page.evaluate(async ({ count, radius }) => {
    const view = document.querySelector('lightwell-view');
    const image = new Image();
    image.src = view.toDataURL();
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
    const pixels = image.height / 2 / Math.tan(0.2) / 6;
    return Array.from({ length: count }, (_, i) =>
      [0, 0.5, 0.8, 0.9].map((share) => {
        const x = image.width / 2 + pixels * (i - (count - 1) / 2);
        const [red] = context.getImageData(Math.round(x), Math.round(image.height / 2 - share * radius * pixels), 1, 1).data;
        return linear(red / 255);
      }),
    );
  }, { count: names.length, radius: RADIUS });
  // Half of the radiance of 1, by the exposure.
  names.forEach((name, i) =>
    found[i].forEach((light, k) => assert.ok(Math.abs(light - 0.5) < LOST / 2 + 0.003, `${name}, place ${k}: ${found[i]}`)),
  );
  assert.deepEqual(errors, []);
});

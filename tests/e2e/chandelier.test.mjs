// SPDX-License-Identifier: Apache-2.0
//
// Thousands of shining triangles: the strongest pieces are lamps of the page, the others stay in the light grid, and together they give the
// light of all.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { BIN, bake, temporaryFolder } from './packs.mjs';
import { room, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

const SIZE = { width: 320, height: 180 };
const CANDLES = 250;
/** Stops: nothing but the candles is beyond the screen's range. */
const EXPOSURE = '1';

const folder = temporaryFolder();
const browser = await forAllTests(launch());
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });

/** Candles on three rings around an axis, each an octahedron of eight faces. */
function chandelier() {
  const candles = { positions: [], normals: [], texcoords: [], indices: [] };
  const size = 0.012;
  for (let i = 0; i < CANDLES; i++) {
    const [ring, angle] = [i % 3, (2 * Math.PI * i) / CANDLES];
    const middle = [(0.3 - 0.07 * ring) * Math.cos(angle), 0.45 + 0.08 * ring, (0.3 - 0.07 * ring) * Math.sin(angle)];
    const corner = (axis, side) => middle.map((m, a) => m + (a === axis ? side * size : 0));
    for (let face = 0; face < 8; face++) {
      const sides = [0, 1, 2].map((axis) => ((face >> axis) & 1 ? 1 : -1));
      const corners = sides.map((side, axis) => corner(axis, side));
      if (sides[0] * sides[1] * sides[2] < 0) corners.reverse();
      const first = candles.positions.length / 3;
      candles.positions.push(...corners.flat());
      for (let k = 0; k < 3; k++) {
        candles.normals.push(...sides.map((side) => side / Math.sqrt(3)));
        candles.texcoords.push(0, 0);
        candles.indices.push(first + k);
      }
    }
  }
  return candles;
}

/** The mean of what a picture shows, linear, without its outermost pixels; runs in the page. */
async function meanOf(page, png) {
  return page.evaluate(async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(1, 1, image.width - 2, image.height - 2);
    const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
    let sum = 0;
    for (let i = 0; i < data.length; i++) if (i % 4 !== 3) sum += linear(data[i] / 255);
    return sum / ((3 * data.length) / 4);
  }, `data:image/png;base64,${png.toString('base64')}`);
}

test('a chandelier of 2,000 triangles gives a room the light that it has by the path tracer', async (t) => {
  const matt = { pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1, baseColorFactor: [0.6, 0.6, 0.6, 1] }, extensions: { KHR_materials_specular: { specularFactor: 0 } } };
  const shining = {
    pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0, 0, 0, 1] },
    emissiveFactor: [1, 1, 1],
    extensions: { KHR_materials_emissive_strength: { emissiveStrength: 12 }, KHR_materials_specular: { specularFactor: 0 } },
  };
  const scene = writeScene(`${folder}/hall.gltf`, [{ mesh: room(1), material: matt }, { mesh: chandelier(), material: shining }]);
  const gltf = JSON.parse(readFileSync(scene, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: 1.2, znear: 0.01 } }];
  // Looks at the floor below the candles and the wall behind it, without a candle in the picture, whose edges would be compared else.
  gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0.1, 0.95], rotation: [-0.26, 0, 0, 0.9656] }) - 1);
  writeFileSync(scene, JSON.stringify(gltf));
  const pack = bake(scene, `${folder}/hall.lw.glb`, { 'target-error': 4, grid: 'auto' });
  const element = `<lightwell-view src="pack.lw.glb" tone="none" exposure="${EXPOSURE}" style="position: fixed; inset: 0"></lightwell-view>`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(element)), '/pack.lw.glb': pack }));
  const { page, errors } = await forTest(t, openPage(browser, SIZE));
  await page.goto(server.url);
  await complete(page);
  const { url, lamps } = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    return { url: view.toDataURL(), lamps: view.pack.lamps.length };
  });
  const options = ['--integrator', 'path', '--spp', '128', '--size', `${SIZE.width}x${SIZE.height}`, '--exposure', EXPOSURE, '--tone', 'none'];
  lightwell('render', scene, '-o', `${folder}/path.png`, ...options);
  const shown = await meanOf(page, Buffer.from(url.split(',')[1], 'base64'));
  const traced = await meanOf(page, readFileSync(`${folder}/path.png`));
  t.diagnostic(`${lamps} lamps; the page shows ${(shown / traced).toFixed(4)} of the path tracer's mean`);
  assert.ok(lamps > 0 && lamps < CANDLES, `${lamps} lamps`);
  // 2 % of the grid's own error, and steps of the screen's bytes.
  assert.ok(Math.abs(shown / traced - 1) < 0.03, `${shown} instead of ${traced}`);
  assert.deepEqual(errors, []);
});

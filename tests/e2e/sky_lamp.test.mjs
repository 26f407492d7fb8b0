// SPDX-License-Identifier: Apache-2.0
//
// The sky as a lamp of many directions, in packs that have its own light apart.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { openScript } from './test_page.mjs';
import { complete } from './view.mjs';

const folder = temporaryFolder();
const browser = await forAllTests(launch());

/** How long the wall of pages/direct_light.ts is to both sides. */
const HALF_WALL = 3;

/** The irradiance of a floor under a sky of radiance 1, so far from a wall 1 high: pi less what the wall takes, by parts of its surface. */
function besideWall(distance, steps = 600) {
  const area = (2 * HALF_WALL) / steps / steps;
  let hidden = 0;
  for (let i = 0; i < steps; i++)
    for (let j = 0; j < steps; j++) {
      const [y, z] = [(i + 0.5) / steps, HALF_WALL * ((2 * (j + 0.5)) / steps - 1)];
      hidden += (area * y * distance) / (distance ** 2 + y ** 2 + z ** 2) ** 2;
    }
  return Math.PI - hidden;
}

/**
 * The largest error, root mean square and in the mean, of 512 directions, half of which come from below the floor. The errors of neighbours
 * are alike: in the mean of a row few of them remain.
 */
const MOST_ERROR = 0.02;
const MOST_BIAS = 0.008;

test('beside a wall the floor has the light of the closed form', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/direct_light.ts');
  await page.waitForFunction(() => globalThis.skyBesideWall);
  const row = await page.evaluate(() => skyBesideWall(2, 512));
  const off = row.map((value, i) => value / besideWall((2 * (i + 0.5)) / row.length) - 1);
  const error = Math.sqrt(off.reduce((sum, x) => sum + x * x, 0) / off.length);
  const bias = off.reduce((sum, x) => sum + x, 0) / off.length;
  t.diagnostic(`error ${error.toFixed(4)}, bias ${bias.toFixed(4)}`);
  assert.ok(error < MOST_ERROR && Math.abs(bias) < MOST_BIAS, `error ${error}, bias ${bias}`);
  assert.deepEqual(errors, []);
});

const MATT = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.6, 0.6, 0.6, 1] }, extensions: { KHR_materials_specular: { specularFactor: 0 } } };

/** A Radiance picture: bright and warm to one side, blue above, dark below. */
function writeSky(file, width = 64) {
  const height = width / 2;
  const pixels = [];
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const [azimuth, polar] = [2 * Math.PI * ((x + 0.5) / width - 0.5), (Math.PI * (y + 0.5)) / height];
      const [toX, up] = [Math.sin(polar) * Math.sin(azimuth), Math.cos(polar)];
      const warm = Math.max(0, toX) ** 4;
      pixels.push(...[30 + 200 * warm, 40 + 60 * warm, 60 + 30 * Math.max(0, up)].map((value) => Math.round(up < 0 ? value / 8 : value)), 130);
    }
  const header = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`;
  writeFileSync(file, Buffer.concat([Buffer.from(header), Buffer.from(pixels)]));
  return file;
}

/** A box turned outwards. */
function box(size) {
  const inside = room(size);
  return { ...inside, normals: inside.normals.map((n) => -n), indices: inside.indices.map((_, i, all) => all[i - (i % 3) + 2 - (i % 3)]) };
}

/** Balls and a box on a floor that fills the picture, seen from above. */
function packUnder(name, environment) {
  const file = writeScene(`${folder}/${name}.gltf`, [
    { mesh: box(4), material: MATT, at: [0, -4, 0] },
    { mesh: sphere(0.3, 32), material: MATT, at: [-0.45, 0.3, 0] },
    { mesh: sphere(0.15, 32), material: MATT, at: [0.1, 0.15, 0.35] },
    { mesh: box(0.25), material: MATT, at: [0.5, 0.25, -0.1] },
  ]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: 0.7, znear: 0.1 } }];
  const tilt = -0.9;
  gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 2.2, 1.8], rotation: [Math.sin(tilt / 2), 0, 0, Math.cos(tilt / 2)] }) - 1);
  writeFileSync(file, JSON.stringify(gltf));
  return bake(file, `${folder}/${name}.lw.glb`, { environment, 'sky-apart': true, grid: 'auto', 'target-error': 4 });
}

const differenceOf = (a, b) => JSON.parse(execFileSync(`${BIN}/lightwell`, ['diff', a, b, '--metric', 'deltae', '--json', '--quiet'], { encoding: 'utf8' }));

async function open(t, pack) {
  const opened = await openScript(t, browser, 'tests/e2e/pages/lambert.ts', { query: '', '/pack.lw.glb': pack });
  await complete(opened.page);
  return opened;
}

async function pictureOf(page, file) {
  const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
  writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
}

const settle = (page) =>
  page.evaluate(async () => {
    const { pack } = document.querySelector('lightwell-view');
    pack.setShadows('soft', 10_000);
    do await new Promise(requestAnimationFrame);
    while (pack.shadowSamples < Infinity);
  });

/** CIEDE2000 to the picture of `render` from the same grid and the sky's light by rays, whose noise is in it; 1 is just visible. */
const MEAN = 0.5;
const P95 = 1;

for (const [name, environment] of [
  ['uniform', '1,1,1'],
  ['picture', writeSky(`${folder}/sky.hdr`)],
])
  test(`at rest a scene under a ${name} sky looks as lightwell render shows it, and nearer to the path tracer than the grid alone`, async (t) => {
    const pack = packUnder(name, environment);
    const { page, errors } = await open(t, pack);
    const [first, last, ivg, path] = ['first', 'last', 'ivg', 'path'].map((part) => `${folder}/${name}-${part}.png`);
    await page.evaluate(() => document.querySelector('lightwell-view').pack.setShadows('hard'));
    await pictureOf(page, first);
    await settle(page);
    await pictureOf(page, last);
    for (const [integrator, file] of [['ivg', ivg], ['path', path]]) {
      const picture = ['--integrator', integrator, '--tone', 'none', '--size', '320x180', '--spp', '1024', '--quiet'];
      execFileSync(`${BIN}/lightwell`, ['render', pack, '-o', file, ...picture]);
    }
    const [before, after, byGrid] = [differenceOf(path, first), differenceOf(path, last), differenceOf(ivg, last)];
    const words = ({ mean, p95 }) => `mean ${mean.toFixed(2)}, 95th percentile ${p95.toFixed(2)}`;
    t.diagnostic(`to the path tracer ${words(before)} at first, ${words(after)} at rest; to render ${words(byGrid)}`);
    assert.ok(byGrid.mean <= MEAN && byGrid.p95 <= P95, words(byGrid));
    assert.ok(after.mean < before.mean && after.p95 < before.p95, words(after));
    assert.deepEqual(errors, []);
  });

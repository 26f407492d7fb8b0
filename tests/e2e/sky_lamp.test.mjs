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

// What the wall hides, and the grid does not know of, is as bright as the floor: white among white is nowhere darker than the open sky.
test('what a white floor does not get from the sky it gets from the wall that hides it', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/direct_light.ts');
  await page.waitForFunction(() => globalThis.skyBesideWall);
  const row = await page.evaluate(() => skyBesideWall(2, 512, true));
  const off = Math.max(...row.map((value) => Math.abs(value / Math.PI - 1)));
  t.diagnostic(`off by ${off.toFixed(4)} at most`);
  // Shares are whole numbers of 12 bits, and the grid's light is in half floats.
  assert.ok(off < 0.005, `${off}`);
  assert.deepEqual(errors, []);
});

const MATT = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.6, 0.6, 0.6, 1] }, extensions: { KHR_materials_specular: { specularFactor: 0 } } };

/** A Radiance picture: bright and warm to +x, cold to +z, blue above, dark below. */
function writeSky(file, width = 64) {
  const height = width / 2;
  const pixels = [];
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const [azimuth, polar] = [2 * Math.PI * ((x + 0.5) / width - 0.5), (Math.PI * (y + 0.5)) / height];
      const [toX, up, toZ] = [Math.sin(polar) * Math.sin(azimuth), Math.cos(polar), -Math.sin(polar) * Math.cos(azimuth)];
      const [warm, cold] = [toX, toZ].map((along) => Math.max(0, along) ** 4);
      pixels.push(...[30 + 200 * warm, 40 + 60 * warm + 60 * cold, 60 + 30 * Math.max(0, up) + 90 * cold].map((value) => Math.round(up < 0 ? value / 8 : value)), 130);
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

const packs = new Map();

/** Balls and a box on a floor that fills the picture, seen from above; baked once. */
function packUnder(name, environment) {
  if (packs.has(name)) return packs.get(name);
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
  packs.set(name, bake(file, `${folder}/${name}.lw.glb`, { environment, 'sky-apart': 'always', grid: 'auto', 'target-error': 4 }));
  return packs.get(name);
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

/**
 * CIEDE2000 to the picture of `render` from the same grid and the sky's light by rays; 1 is just visible. Noise is most of it: under a picture of
 * a sky two of those, by other seeds, differ by 0.67 in the mean and 1.31 at the 95th percentile.
 */
const MEAN = 0.65;
const P95 = 1.3;

/** What is left of the grid's own difference to the path tracer, whose noise is in both. */
const MOST_OF_GRID = 0.6;

const SKY = writeSky(`${folder}/sky.hdr`);

for (const [name, environment] of [
  ['uniform', '1,1,1'],
  ['picture', SKY],
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
      const picture = ['--integrator', integrator, '--tone', 'none', '--size', '320x180', '--spp', '512', '--quiet'];
      execFileSync(`${BIN}/lightwell`, ['render', pack, '-o', file, ...picture]);
    }
    const [before, after, byGrid] = [differenceOf(path, first), differenceOf(path, last), differenceOf(ivg, last)];
    const words = ({ mean, p95 }) => `mean ${mean.toFixed(2)}, 95th percentile ${p95.toFixed(2)}`;
    t.diagnostic(`to the path tracer ${words(before)} at first, ${words(after)} at rest; to render ${words(byGrid)}`);
    assert.ok(byGrid.mean <= MEAN && byGrid.p95 <= P95, words(byGrid));
    assert.ok(after.mean < MOST_OF_GRID * before.mean && after.p95 < MOST_OF_GRID * before.p95, words(after));
    assert.deepEqual(errors, []);
  });

/** Between two pictures of the same, whose directions fall on other texels; 1 is just visible. */
const ALIKE = 0.4;

test('the sky turns with its pack', async (t) => {
  const { page, errors } = await open(t, packUnder('picture', SKY));
  await settle(page);
  await pictureOf(page, `${folder}/straight.png`);
  await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    const { theta, phi, radius, target } = view.view;
    const turn = 0.7;
    view.pack.rotation.y = turn;
    const [x, y, z] = target;
    const turned = [x * Math.cos(turn) + z * Math.sin(turn), y, z * Math.cos(turn) - x * Math.sin(turn)];
    view.view = { theta: theta + turn, phi, radius, target: turned };
    view.draw();
  });
  await settle(page);
  await pictureOf(page, `${folder}/turned.png`);
  const { mean } = differenceOf(`${folder}/straight.png`, `${folder}/turned.png`);
  assert.ok(mean < ALIKE, `${mean}`);
  assert.deepEqual(errors, []);
});

/** The light of the picture's pixels, of one channel, less what is beyond white. */
const lightOf = (page) =>
  page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.draw();
    const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
    const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return [...pixels].filter((_, i) => i % 4 === 1).map((byte) => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4));
  });

const METAL = { pbrMetallicRoughness: { metallicFactor: 1, roughnessFactor: 0.2, baseColorFactor: [0.9, 0.9, 0.9, 1] } };
/** Two roundings to 8 bits, each at most half a step of sRGB, which is 0.0045 of white where its curve is steepest, and those of shares. */
const ROUNDING = 0.012;
/** The pixels at outlines, whose fragments are averaged as they are encoded. */
const OUTLINES = 0.01;

test('at rest the sky is dimmed without a new direction, what is matt and what mirrors alike', async (t) => {
  const file = writeScene(`${folder}/two.gltf`, [
    { mesh: sphere(0.4, 32), material: METAL, at: [-0.5, 0, 0] },
    { mesh: sphere(0.4, 32), material: MATT, at: [0.5, 0, 0] },
  ]);
  const pack = bake(file, `${folder}/two.lw.glb`, { environment: SKY, 'sky-apart': 'always', grid: 'auto', 'target-error': 4 });
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/element.ts', { '/pack.lw.glb': pack });
  await page.evaluate(() => {
    const attributes = 'tone="none" exposure="-1" environment-background="none" style="position: fixed; inset: 0"';
    document.body.innerHTML = `<lightwell-view src="pack.lw.glb" ${attributes}></lightwell-view>`;
  });
  await complete(page);
  await settle(page);
  const pictures = [];
  for (const factor of [1, 0, 0.5]) {
    const samples = await page.evaluate(async (of) => {
      const { pack } = document.querySelector('lightwell-view');
      const states = pack.grids.map(({ newest }) => newest);
      pack.setSkyLight(of);
      while (pack.grids.some(({ newest }, i) => newest === states[i])) await new Promise(requestAnimationFrame);
      return pack.shadowSamples;
    }, factor);
    assert.equal(samples, Infinity);
    pictures.push(await lightOf(page));
  }
  const [all, none, half] = pictures;
  assert.ok(all.filter((light, i) => light > none[i] + 0.05).length > 1000, 'the sky shines');
  const off = half.filter((light, i) => Math.abs(light - (all[i] + none[i]) / 2) > ROUNDING);
  assert.ok(off.length < OUTLINES * half.length, `${off.length} pixels of ${half.length}`);
  assert.deepEqual(errors, []);
});

test('an object that takes no shadows has the light of the open sky, whatever else is in the picture', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/direct_light.ts');
  await page.waitForFunction(() => globalThis.skyOnOwnObject);
  const light = await page.evaluate(() => skyOnOwnObject(64));
  assert.ok(Math.abs(light - Math.PI) < 0.01 * Math.PI, `${light}`);
  assert.deepEqual(errors, []);
});

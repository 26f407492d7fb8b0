// SPDX-License-Identifier: Apache-2.0
//
// A large image comes in levels: it is nearly itself long before all of its bytes have come.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { crc32, deflateSync } from 'node:zlib';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { replaceInJson } from './pack_edits.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { writeScene } from './scenes.mjs';
import { startServe } from './servers.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { loaded } from './view.mjs';

const SIDE = 1024;
/** Of waves, in texels: finer than the preview, which has one in sixteen, coarser than the level, which has one in four. */
const WAVE = 24;

/** A PNG file of waves, and noise that makes it large. */
function waves(seed) {
  let state = seed;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const rows = Buffer.alloc(SIDE * (3 * SIDE + 1));
  for (let y = 0, at = 0; y < SIDE; y++) {
    rows[at++] = 0;
    for (let x = 0; x < SIDE; x++)
      for (const height of [60, 50, 40]) rows[at++] = 128 + height * Math.sin((2 * Math.PI * (x + 0.3 * y)) / WAVE) + 16 * (random() - 0.5);
  }
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    length.writeUInt32BE(data.length);
    sum.writeUInt32BE(crc32(body));
    return Buffer.concat([length, body, sum]);
  };
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0]);
  header.writeUInt32BE(SIDE, 0);
  header.writeUInt32BE(SIDE, 4);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', header), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

/** Two squares beside one another that show waves without any light: the second one by a sampler without mip levels. */
function writeSquares(file) {
  const square = { positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], normals: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1], texcoords: [0, 1, 1, 1, 1, 0, 0, 0], indices: [0, 1, 2, 0, 2, 3] };
  const material = (index) => ({ pbrMetallicRoughness: { baseColorTexture: { index } }, extensions: { KHR_materials_unlit: {} } });
  writeScene(file, [0, 1].map((index) => ({ mesh: square, material: material(index), at: [2.1 * index - 1.05, 0, 0] })), [{ lamp: { type: 'point', intensity: 1 }, at: [0, 0, 2] }]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.images = [1, 2].map((seed) => ({ uri: `data:image/png;base64,${waves(seed).toString('base64')}` }));
  gltf.samplers = [{}, { minFilter: 9729 }];
  gltf.textures = [0, 1].map((index) => ({ source: index, sampler: index }));
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

const folder = temporaryFolder();
const PACK = bake(writeSquares(`${folder}/squares.gltf`), `${folder}/squares.lw.glb`, { photons: '1k', grid: 3 });
const PLAIN = replaceInJson(PACK, `${folder}/plain.lw.glb`, '"levels"', '"lexels"');
const browser = await forAllTests(launch());

/** Runs in the page: the two squares as they are drawn, a list of numbers each, until all has come; and whether their textures stayed the same. */
async function watch() {
  const view = document.querySelector('lightwell-view');
  const maps = () => {
    const found = [];
    view.pack.traverse(({ material }) => material?.map && found.push(material.map));
    return found;
  };
  const before = maps();
  const canvas = new OffscreenCanvas(320, 180);
  const context = canvas.getContext('2d', { willReadFrequently: true });
  const shots = [];
  for (let last = false; !last; ) {
    last = view.complete;
    const image = new Image();
    image.src = view.toDataURL();
    await image.decode();
    context.drawImage(image, 0, 0);
    shots.push([40, 170].map((x) => [...context.getImageData(x, 40, 110, 100).data]));
    if (!last) await new Promise((resolve) => setTimeout(resolve, 100));
  }
  return { shots, same: maps().every((map, i) => map === before[i]) };
}

const differenceOf = (a, b) => Math.sqrt(a.reduce((sum, x, i) => sum + (x - b[i]) ** 2, 0) / a.length);

const middleOf = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** What was shown of a pack that came slowly: how far both squares were from what they became, in the middle of the time; and the last picture. */
async function watchSlowly(t, pack) {
  const server = await forTest(t, startServe(pack));
  const relay = await forTest(t, startSlowRelay(server.url, 1e6));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(relay.url);
  await loaded(page);
  const { shots, same } = await page.evaluate(watch);
  const last = shots.at(-1);
  assert.ok(same, 'textures stay what they are');
  assert.deepEqual(errors, []);
  return { off: [0, 1].map((square) => middleOf(shots.map((shot) => differenceOf(shot[square], last[square])))), last };
}

test('a large image is nearly itself when its level has come, and in the end all of it; without mip levels it comes at once', async (t) => {
  const [levelled, plain] = [await watchSlowly(t, PACK), await watchSlowly(t, PLAIN)];
  t.diagnostic(`with levels off by ${levelled.off}, without by ${plain.off}`);
  assert.ok(levelled.off[0] > 0 && levelled.off[0] < plain.off[0] / 2);
  assert.ok(Math.abs(levelled.off[1] - plain.off[1]) < 0.05 * plain.off[1]);
  // In the end the picture is that of a pack without levels, of a camera that comes to rest within a part of a pixel.
  const apart = levelled.last.map((square, i) => differenceOf(square, plain.last[i]));
  apart.forEach((off, i) => assert.ok(off < 0.1 * plain.off[i], `off by ${apart}`));
});

// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { RECORD_GL } from './gl_recorder.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder, writeSamplePack } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete } from './view.mjs';

const BYTES_PER_FRAME = 256 * 1024;
/** Many full frames and levels, and far from PATIENCE without a GPU: 2.5 s on two processors with a load of 8. */
const FACES = 100_000;
/** From an opening of at most 12,000 faces, each level at most twice the last: 12, 24, 48, 96 and 100 thousand at least. */
const LEVELS = 5;
/** Starts the record with the first frame's end. */
const RECORD_FROM_OPENING = `addEventListener('DOMContentLoaded', () => {
  const view = document.querySelector('lightwell-view');
  globalThis.levels = new Set();
  const count = () => {
    let faces = 0;
    view.pack.traverse(({ geometry }) => (faces += geometry ? geometry.drawRange.count : 0));
    levels.add(faces);
  };
  view.addEventListener('load', () => (count(), view.pack.addEventListener('geometry', count)));
  view.addEventListener('firstframe', () => glRecord.reset());
});`;

const BALLS = 40;

const folder = temporaryFolder();
const LARGE = writeSamplePack(`${folder}/large.lw.glb`, FACES);

const browser = await forAllTests(launch());

/** Shows a pack to its end. Gives the bytes that each frame was handed, the names of what was allocated, and the levels shown. */
async function stream(t, file) {
  const server = await forTest(t, startStaticServer({ ...viewerPage('/pack.lw.glb'), '/pack.lw.glb': file }));
  const { page, errors } = await forTest(t, openPage(browser, { init: RECORD_GL + RECORD_FROM_OPENING }));
  await page.goto(server.url);
  await complete(page);
  assert.deepEqual(errors, []);
  return page.evaluate(() => ({ ...globalThis.glRecord, levels: globalThis.levels.size }));
}

function assertFramesAreEven({ frames, allocations }, leastBytes) {
  assert.deepEqual(allocations, []);
  assert.ok(Math.max(...frames) <= BYTES_PER_FRAME, `${Math.max(...frames)} bytes in one frame`);
  const total = frames.reduce((sum, bytes) => sum + bytes, 0);
  assert.ok(total > leastBytes, `only ${total} bytes were seen`);
}

test('after the first frame nothing is allocated, a frame is handed at most 256 KB, and the mesh grows level by level', async (t) => {
  const record = await stream(t, LARGE);
  assertFramesAreEven(record, 1e6);
  assert.ok(record.levels >= LEVELS, `only ${record.levels} levels were shown`);
});

test('nor is anything in a scene of many meshes, most of them out of sight', async (t) => {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const balls = Array.from({ length: BALLS }, (_, i) => ({ mesh: sphere(0.4), material, at: [i - BALLS / 2, 0, 0] }));
  const lamp = { lamp: { type: 'point', intensity: 10 }, at: [0, 2, 0] };
  const scene = writeScene(`${folder}/balls.gltf`, balls, [lamp]);
  const gltf = JSON.parse(readFileSync(scene, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: 0.5, znear: 0.01 } }];
  gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0, 3] }) - 1);
  writeFileSync(scene, JSON.stringify(gltf));
  assertFramesAreEven(await stream(t, bake(scene, `${folder}/balls.lw.glb`)), 1e6);
});

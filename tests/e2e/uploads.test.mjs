// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { RECORD_GL } from './gl_recorder.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { complete } from './view.mjs';

const BYTES_PER_FRAME = 256 * 1024;
/** 200,000 faces by way of at most 12,000, each level at most twice the last, and the opening itself: 5 at least. */
const LEVELS = 5;
/** Starts the record two frames after the first: then everything has been drawn, and so allocated, once. */
const RECORD_FROM_OPENING = `addEventListener('DOMContentLoaded', () => {
  const view = document.querySelector('lightwell-view');
  globalThis.levels = new Set();
  const count = () => {
    let faces = 0;
    view.pack.traverse(({ geometry }) => (faces += geometry ? geometry.drawRange.count : 0));
    levels.add(faces);
  };
  view.addEventListener('load', () => (count(), view.pack.addEventListener('geometry', count)));
  view.addEventListener('firstframe', () =>
    requestAnimationFrame(() => requestAnimationFrame(() => { glRecord.reset(); globalThis.recording = true; })));
});`;

const folder = temporaryFolder();
writeSamplePack(`${folder}/large.lw.glb`, 200_000);

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test('after the opening nothing is allocated, a frame is handed at most 256 KB, and the mesh grows level by level', async (t) => {
  const packs = { packs: [{ name: 'large.lw.glb', url: '/packs/large.lw.glb' }] };
  const server = await startStaticServer({
    '/': `${WEB}dist`,
    '/packs/': folder,
    '/packs.json': { text: JSON.stringify(packs), type: 'application/json' },
  });
  t.after(() => server.stop());
  const { page, errors, close } = await openPage(browser, { init: RECORD_GL + RECORD_FROM_OPENING });
  t.after(close);
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.recording);
  await complete(page);
  const { frames, allocations } = await page.evaluate(() => globalThis.glRecord);
  const total = frames.reduce((sum, bytes) => sum + bytes, 0);
  assert.deepEqual(allocations, []);
  assert.ok(Math.max(...frames) <= BYTES_PER_FRAME, `${Math.max(...frames)} bytes in one frame`);
  assert.ok(total > 1e6, `only ${total} bytes were seen`);
  const levels = await page.evaluate(() => globalThis.levels.size);
  assert.ok(levels >= LEVELS, `only ${levels} levels were shown`);
  assert.deepEqual(errors, []);
});

// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { copyFileSync, mkdirSync, renameSync, statSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startNginx, startServe } from './servers.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete, loaded, notice, pauseAfter, paused, progress, resume } from './view.mjs';

const folder = temporaryFolder();
const SMALL = writeSamplePack(`${folder}/small.lw.glb`, 20_000);
const LARGE = writeSamplePack(`${folder}/large.lw.glb`, 200_000);
const OTHER = writeSamplePack(`${folder}/other.lw.glb`, 150_000);

/** Bytes a second of each response, where a test has to act in mid-stream. */
const SLOW = 100_000;

const browser = await forAllTests(launch());

/** The page with a pack that lies at `base`, on a server of its own. */
async function staticPage(t, name, { base = '/packs/', init, slowly = false, ...options } = {}) {
  let server = await forTest(t, startStaticServer({ ...viewerPage(`${base}${name}`), '/packs/': folder }, options));
  if (slowly) server = await forTest(t, startSlowRelay(server.url, SLOW));
  const opened = await forTest(t, openPage(browser, { init }));
  await opened.page.goto(server.url);
  return opened;
}

async function assertComplete(page, file) {
  await complete(page);
  const { bytes, geometry, light, faces } = await progress(page);
  assert.equal(bytes.done, statSync(file).size);
  for (const share of [geometry, light, faces]) assert.equal(share.done, share.total);
  return faces.total;
}

test('the page streams a pack to completion from lightwell serve', async (t) => {
  const server = await forTest(t, startServe(SMALL));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('and from nginx of another origin', async (t) => {
  const nginx = await forTest(t, startNginx(folder, `${folder}/nginx`));
  const { page, errors } = await staticPage(t, 'small.lw.glb', { base: nginx.url });
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('from a server without ranges, and with a wrong type of WebAssembly', async (t) => {
  const { page, errors } = await staticPage(t, 'small.lw.glb', { ranges: false, wasmType: 'application/octet-stream' });
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('without a worker', async (t) => {
  const { page, errors } = await staticPage(t, 'small.lw.glb', {
    init: `globalThis.Worker = class { constructor() { throw new Error('forbidden'); } };`,
  });
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('each strategy ends in the same state', async (t) => {
  const { page } = await staticPage(t, 'small.lw.glb');
  const totals = new Set();
  for (const strategy of ['geometry', 'light', 'interleave']) {
    await page.evaluate((value) => {
      const view = document.querySelector('lightwell-view');
      view.setAttribute('strategy', value);
      view.setAttribute('src', '/packs/small.lw.glb');
    }, strategy);
    totals.add(await assertComplete(page, SMALL));
  }
  assert.equal(totals.size, 1);
});

test('a server that dies is waited for, what has come is kept', async (t) => {
  const server = await forTest(t, startServe(LARGE));
  const relay = await forTest(t, startSlowRelay(server.url, SLOW));
  const { page, errors } = await forTest(t, openPage(browser, { init: pauseAfter(100_000) }));
  await page.goto(relay.url);
  await paused(page);
  const { faces } = await progress(page);
  await server.close('SIGKILL');
  await resume(page);
  await notice(page, 'does not answer');
  assert.ok((await progress(page)).faces.done >= faces.done);
  await forTest(t, startServe(LARGE, Number(new URL(server.url).port)));
  await assertComplete(page, LARGE);
  await notice(page, '');
  assert.deepEqual(errors, []);
});

test('a file that is replaced in mid-stream is said and loaded anew', async (t) => {
  mkdirSync(`${folder}/changing`);
  const file = `${folder}/changing/large.lw.glb`;
  copyFileSync(LARGE, file);
  const { page, errors } = await staticPage(t, 'large.lw.glb', { base: '/packs/changing/', init: pauseAfter(100_000), slowly: true });
  await paused(page);
  copyFileSync(OTHER, `${file}.new`);
  renameSync(`${file}.new`, file);
  const replaced = page.evaluate(
    () => new Promise((resolve) => document.querySelector('lightwell-view').on('error', ({ reason }) => resolve(reason))),
  );
  await resume(page);
  assert.equal(await replaced, 'replaced');
  await page.waitForFunction((size) => document.querySelector('lightwell-view').progress?.bytes.total === size, statSync(OTHER).size);
  await resume(page);
  await assertComplete(page, OTHER);
  assert.deepEqual(errors, []);
});

test('the camera is in the address', async (t) => {
  const { page } = await staticPage(t, 'small.lw.glb');
  await loaded(page);
  await page.evaluate(() => (document.querySelector('lightwell-view').view = { theta: 0.5, phi: 1, radius: 3, target: [0, 1, 0] }));
  await page.waitForFunction(() => location.hash.includes('view=0.5,1,3,0,1,0'));
  await page.reload();
  await loaded(page);
  await page.waitForFunction(() => Math.abs((document.querySelector('lightwell-view').view?.radius ?? 0) - 3) < 1e-6);
});

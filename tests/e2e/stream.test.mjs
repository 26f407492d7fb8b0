// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { copyFileSync, mkdirSync, renameSync, statSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startNginx, startServe } from './servers.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { startStaticServer } from './static_server.mjs';
import { complete, loaded, notice, pauseAfter, paused, progress, resume } from './view.mjs';

const folder = temporaryFolder();
const SMALL = writeSamplePack(`${folder}/small.lw.glb`, 20_000);
const LARGE = writeSamplePack(`${folder}/large.lw.glb`, 200_000);
const OTHER = writeSamplePack(`${folder}/other.lw.glb`, 150_000);

/** Bytes a second of each response, where a test has to act in mid-stream. */
const SLOW = 100_000;

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** The page with packs that lie at `base`, on a server of its own. */
function pageRoutes(names, base = '/packs/') {
  const packs = names.map((name) => ({ name, url: `${base}${name}` }));
  return {
    '/': `${WEB}dist`,
    '/packs/': folder,
    '/packs.json': { text: JSON.stringify({ packs }), type: 'application/json' },
  };
}

async function staticPage(t, names, { base, init, slowly = false, ...options } = {}) {
  let server = await startStaticServer(pageRoutes(names, base), options);
  t.after(server.stop);
  if (slowly) t.after((server = await startSlowRelay(server.url, SLOW)).stop);
  const opened = await openPage(browser, { init });
  t.after(() => opened.close());
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
  const server = await startServe(SMALL);
  t.after(() => server.stop());
  const { page, errors, close } = await openPage(browser);
  t.after(close);
  await page.goto(server.url);
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('and from nginx of another origin', async (t) => {
  const nginx = await startNginx(folder, `${folder}/nginx`);
  t.after(() => nginx.stop());
  const { page, errors } = await staticPage(t, ['small.lw.glb'], { base: nginx.url });
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('from a server without ranges, and with a wrong type of WebAssembly', async (t) => {
  const { page, errors } = await staticPage(t, ['small.lw.glb'], { ranges: false, wasmType: 'application/octet-stream' });
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('without a worker', async (t) => {
  const { page, errors } = await staticPage(t, ['small.lw.glb'], {
    init: `globalThis.Worker = class { constructor() { throw new Error('forbidden'); } };`,
  });
  await assertComplete(page, SMALL);
  assert.deepEqual(errors, []);
});

test('each strategy ends in the same state', async (t) => {
  const { page } = await staticPage(t, ['small.lw.glb']);
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
  let server = await startServe(LARGE);
  t.after(() => server.stop());
  const relay = await startSlowRelay(server.url, SLOW);
  t.after(relay.stop);
  const { page, errors, close } = await openPage(browser, { init: pauseAfter(100_000) });
  t.after(close);
  await page.goto(relay.url);
  await paused(page);
  const { faces } = await progress(page);
  await server.stop('SIGKILL');
  await resume(page);
  await notice(page, 'does not answer');
  assert.ok((await progress(page)).faces.done >= faces.done);
  server = await startServe(LARGE, Number(new URL(server.url).port));
  await assertComplete(page, LARGE);
  await notice(page, '');
  assert.deepEqual(errors, []);
});

test('a file that is replaced in mid-stream is said and loaded anew', async (t) => {
  mkdirSync(`${folder}/changing`);
  const file = `${folder}/changing/large.lw.glb`;
  copyFileSync(LARGE, file);
  const { page, errors } = await staticPage(t, ['large.lw.glb'], { base: '/packs/changing/', init: pauseAfter(100_000), slowly: true });
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
  const { page } = await staticPage(t, ['small.lw.glb']);
  await loaded(page);
  await page.evaluate(() => (document.querySelector('lightwell-view').view = { theta: 0.5, phi: 1, radius: 3, target: [0, 1, 0] }));
  await page.waitForFunction(() => location.hash.includes('view=0.5,1,3,0,1,0'));
  await page.reload();
  await loaded(page);
  await page.waitForFunction(() => Math.abs((document.querySelector('lightwell-view').view?.radius ?? 0) - 3) < 1e-6);
});

// SPDX-License-Identifier: Apache-2.0
//
// How a load begins and ends: what is given up, what is said when it fails, and when it is tried anew.
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { COUNT_OBJECTS } from './gl_recorder.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete, loaded, notice, progress } from './view.mjs';

const folder = temporaryFolder();
const SMALL = writeSamplePack(`${folder}/small.lw.glb`, 5_000);
/** Its opening does not fit into the first request. */
const LARGE = writeSamplePack(`${folder}/large.lw.glb`, 200_000);

/** Runs in the page before its scripts: `workers` counts those that were started and those that live. */
const COUNT_WORKERS = `globalThis.workers = { started: 0, alive: 0 };
globalThis.Worker = class extends Worker {
  constructor(...values) { super(...values); workers.started++; workers.alive++; }
  terminate() { workers.alive--; super.terminate(); }
};`;

/** Runs in the page before its scripts: `listeners` counts those that wait for signals to abort. */
const COUNT_LISTENERS = `globalThis.listeners = 0;
const { addEventListener: add, removeEventListener: remove } = AbortSignal.prototype;
AbortSignal.prototype.addEventListener = function (...values) { listeners++; add.apply(this, values); };
AbortSignal.prototype.removeEventListener = function (...values) { listeners--; remove.apply(this, values); };`;

/** Runs in the page before its scripts: moves the element out of sight. */
const OUT_OF_SIGHT = `addEventListener('DOMContentLoaded', () =>
  (document.querySelector('lightwell-view').style.transform = 'translateY(5000px)'));`;

/** Bytes a second: most of the pack is still to come when its opening is shown. */
const SLOW = 100_000;
/** Much longer than any pause between two pieces of a pack that is on its way; milliseconds. */
const REST = 1000;

/** Runs in the page before its scripts: `failures` collects the element's errors, with the time. */
const NOTE_FAILURES = `globalThis.failures = [];
addEventListener('DOMContentLoaded', () =>
  document.querySelector('lightwell-view').addEventListener('error', ({ detail }) =>
    failures.push({ ...detail, time: performance.now() })));`;

const browser = await forAllTests(launch());

/** The page with the pack that `packFile` names for each request of /pack.lw.glb; small.lw.glb lies beside it. */
async function openPack(t, packFile, init = '') {
  const server = await forTest(t, startStaticServer({
    ...viewerPage('/pack.lw.glb'),
    '/small.lw.glb': SMALL,
    get '/pack.lw.glb'() {
      return packFile();
    },
  }));
  const opened = await forTest(t, openPage(browser, { init: NOTE_FAILURES + init }));
  await opened.page.goto(server.url);
  return opened;
}

const setSource = (page, url) => page.evaluate((src) => document.querySelector('lightwell-view').setAttribute('src', src), url);
const failures = (page, count) =>
  page.waitForFunction((least) => globalThis.failures.length >= least && globalThis.failures, count).then((handle) => handle.jsonValue());

test('a load that another one follows is given up, though its server never answers', async (t) => {
  const silent = createServer(() => {});
  await new Promise((resolve) => silent.listen(0, '127.0.0.1', resolve));
  t.after(() => (silent.closeAllConnections(), silent.close()));
  const asked = new Promise((resolve) => silent.once('request', (request) => resolve(request)));
  const { page, errors } = await openPack(t, () => SMALL, COUNT_WORKERS);
  await complete(page);
  await setSource(page, `http://127.0.0.1:${silent.address().port}/pack.lw.glb`);
  const request = await asked;
  const ended = new Promise((resolve) => request.once('close', resolve));
  await setSource(page, '/small.lw.glb');
  await ended;
  await complete(page);
  assert.equal(await page.evaluate(() => globalThis.workers.alive), 1);
  assert.deepEqual(await page.evaluate(() => globalThis.failures), []);
  assert.deepEqual(errors, []);
});

test('a pack that another one follows leaves nothing on the GPU and no listener', async (t) => {
  const { page, errors } = await openPack(t, () => SMALL, COUNT_OBJECTS + COUNT_LISTENERS);
  await complete(page);
  const objects = () => page.evaluate(() => (document.querySelector('lightwell-view').draw(), globalThis.objects));
  const first = await objects();
  await setSource(page, '/small.lw.glb');
  await complete(page);
  assert.deepEqual(await objects(), first);
  assert.equal(await page.evaluate(() => globalThis.listeners), 0);
  assert.deepEqual(errors, []);
});

test('of a pack that loads out of sight the rest comes when it is seen', async (t) => {
  const server = await forTest(t, startStaticServer({ ...viewerPage('/pack.lw.glb'), '/pack.lw.glb': LARGE }));
  const relay = await forTest(t, startSlowRelay(server.url, SLOW));
  const { page, errors } = await forTest(t, openPage(browser, { init: OUT_OF_SIGHT }));
  await page.goto(relay.url);
  await loaded(page);
  let [before, now] = [undefined, await progress(page)];
  while (before?.bytes.done !== now.bytes.done) {
    await page.waitForTimeout(REST);
    [before, now] = [now, await progress(page)];
  }
  assert.ok(now.bytes.done < now.bytes.total, 'all of it came unseen');
  await page.evaluate(() => (document.querySelector('lightwell-view').style.transform = ''));
  await complete(page);
  assert.deepEqual(errors, []);
});

test('an element that comes back to the page loads once, and keeps its view', async (t) => {
  const { page, errors } = await openPack(t, () => SMALL, COUNT_WORKERS);
  await complete(page);
  await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.view = { ...view.view, theta: 1 };
  });
  await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    const { parentNode, nextSibling } = view;
    view.remove();
    parentNode.insertBefore(view, nextSibling);
  });
  await complete(page);
  assert.deepEqual(await page.evaluate(() => globalThis.workers), { started: 2, alive: 1 });
  assert.ok(Math.abs((await page.evaluate(() => document.querySelector('lightwell-view').view.theta)) - 1) < 1e-6);
  assert.deepEqual(errors, []);
});

test('a pack that is not there is refused in words', async (t) => {
  const { page } = await openPack(t, () => `${folder}/missing.lw.glb`);
  const [{ reason, message }] = await failures(page, 1);
  assert.equal(reason, 'refused');
  assert.match(message, /pack\.lw\.glb.*404/);
  await notice(page, '404');
});

test('a file that is replaced while its opening comes is loaded anew', async (t) => {
  let answers = 0;
  const { page, errors } = await openPack(t, () => (answers++ === 0 ? LARGE : SMALL));
  await complete(page);
  const reasons = (await failures(page, 1)).map(({ reason }) => reason);
  assert.deepEqual(reasons, ['replaced']);
  assert.deepEqual(errors, []);
});

test('a file that differs each time is tried ever more rarely', async (t) => {
  let answers = 0;
  const { page } = await openPack(t, () => (answers++ % 2 === 0 ? LARGE : SMALL));
  const times = (await failures(page, 3)).map(({ time }) => time);
  // The pauses are 1 s and 2 s; timers keep them to the millisecond.
  assert.ok(times[1] - times[0] > 995 && times[2] - times[1] > 1995, `failed at ${times} ms`);
});

test('an image that the browser cannot read is said, and the rest comes', async (t) => {
  const { page } = await openPack(t, () => SMALL, `{
    const original = createImageBitmap;
    globalThis.createImageBitmap = (source, ...values) =>
      source instanceof Blob && values[0].resizeWidth ? Promise.reject(new Error('no such format')) : original(source, ...values);
  }`);
  await complete(page);
  const [{ reason, message }] = await failures(page, 1);
  assert.equal(reason, 'unreadable');
  assert.match(message, /image of asset \d+ .*no such format/);
});

test('an update that does not fit the opening ends the stream in words', async (t) => {
  const { page } = await openPack(t, () => SMALL, COUNT_WORKERS);
  await complete(page);
  await page.evaluate(() => {
    const { pack } = document.querySelector('lightwell-view');
    const [{ definition }] = pack.grids;
    pack.receive({ type: 'light', asset: definition.stream, width: 1, height: 1, depth: 1, atlas: new Uint16Array(4) });
  });
  const [{ reason, message }] = await failures(page, 1);
  assert.equal(reason, 'unreadable');
  assert.match(message, /another size/);
  assert.equal(await page.evaluate(() => globalThis.workers.alive), 0);
});

test('a listener that throws does not stop the stream', async (t) => {
  const throwing = `addEventListener('DOMContentLoaded', () => {
    const view = document.querySelector('lightwell-view');
    view.addEventListener('load', () => view.pack.addEventListener('progress', () => { throw new Error('on purpose'); }));
  });`;
  const { page, errors } = await openPack(t, () => SMALL, throwing);
  await complete(page);
  assert.ok(errors.length > 0 && errors.every((error) => /on purpose/.test(error)), `${errors}`);
});

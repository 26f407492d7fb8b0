// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** So long a slow GPU takes, in milliseconds: many of the browser's frames. */
const SLOW = 400;
/** Much longer than ten of the browser's frames and than any pause between two of the element's; milliseconds. */
const LONG_REST = 3000;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 5_000);
const browser = await forAllTests(launch());
const server = await forAllTests(startStaticServer({ ...viewerPage('/pack.lw.glb'), '/pack.lw.glb': PACK }));

async function openView(t, init = undefined) {
  const opened = await forTest(t, openPage(browser, { init }));
  await opened.page.goto(server.url);
  await complete(opened.page);
  return opened;
}

/** Resolves after so many animation frames of the page. */
const frames = (page, count) =>
  page.evaluate(
    (left) =>
      new Promise((resolve) => {
        const next = () => (left-- > 0 ? requestAnimationFrame(next) : resolve());
        next();
      }),
    count,
  );

const picture = (page) => page.evaluate(() => document.querySelector('lightwell-view').toDataURL());

/** Counts in `draws` what is drawn from now on. */
const countDraws = (page) =>
  page.evaluate(() => {
    globalThis.draws = 0;
    const { drawElements } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.drawElements = function (...values) {
      globalThis.draws++;
      return drawElements.apply(this, values);
    };
  });

/** Runs in the page before its scripts: the GPU is done with nothing before SLOW. Notes when it drew last and when all was complete. */
const SLOW_GPU = `globalThis.times = {};
const { fenceSync, getSyncParameter, drawElements } = WebGL2RenderingContext.prototype;
Object.assign(WebGL2RenderingContext.prototype, {
  fenceSync(...values) {
    return Object.assign(fenceSync.apply(this, values), { end: performance.now() + ${SLOW} });
  },
  getSyncParameter(fence, name) {
    return performance.now() < fence.end ? this.UNSIGNALED : getSyncParameter.call(this, fence, name);
  },
  drawElements(...values) {
    times.drawn = performance.now();
    return drawElements.apply(this, values);
  },
});
addEventListener('DOMContentLoaded', () =>
  document.querySelector('lightwell-view').addEventListener('complete', () => (times.complete = performance.now())));`;

/**
 * Runs in the page before its scripts: `requests` holds the animation frames that the page's script asks for, `most` how many were
 * at once. The test's own script waits by frames too.
 */
const COUNT_REQUESTS = `globalThis.requests = new Set();
globalThis.most = 0;
const { requestAnimationFrame, cancelAnimationFrame } = globalThis;
globalThis.requestAnimationFrame = (call) => {
  const request = requestAnimationFrame((time) => (requests.delete(request), call(time)));
  if (!new Error().stack.includes('/page.js')) return request;
  most = Math.max(most, requests.add(request).size);
  return request;
};
globalThis.cancelAnimationFrame = (request) => (requests.delete(request), cancelAnimationFrame(request));`;

test('an element asks for one animation frame at a time, and for none when its picture is still', async (t) => {
  const { page } = await openView(t, COUNT_REQUESTS);
  await page.waitForTimeout(LONG_REST);
  assert.deepEqual(await page.evaluate(() => [globalThis.most, globalThis.requests.size]), [1, 0]);
});

test('completion is said when the GPU has drawn the last picture', async (t) => {
  const { page, errors } = await openView(t, SLOW_GPU);
  await page.waitForTimeout(3 * SLOW);
  const { drawn, complete } = await page.evaluate(() => globalThis.times);
  assert.ok(complete >= drawn + SLOW, `drawn last at ${drawn} ms, said at ${complete} ms`);
  assert.deepEqual(errors, []);
});

test('a still picture is not drawn again', async (t) => {
  const { page } = await openView(t);
  await page.waitForFunction(() => document.querySelector('lightwell-view').frameRate === 0);
  await countDraws(page);
  await frames(page, 10);
  assert.equal(await page.evaluate(() => globalThis.draws), 0);
});

test('a change after a long rest is drawn at once', async (t) => {
  const { page } = await openView(t);
  await page.waitForTimeout(LONG_REST);
  await countDraws(page);
  await page.evaluate(() => document.querySelector('lightwell-view').setAttribute('light', 'direct'));
  await frames(page, 10);
  assert.ok((await page.evaluate(() => globalThis.draws)) > 0);
});

test('keys turn, move and zoom', async (t) => {
  const { page, errors } = await openView(t);
  const view = () => page.evaluate(() => document.querySelector('lightwell-view').view);
  const start = await view();
  await page.evaluate(() => document.querySelector('lightwell-view').shadowRoot.querySelector('canvas').focus());
  for (const [key, changed] of [
    ['ArrowLeft', (now) => now.theta !== start.theta],
    ['Shift+ArrowUp', (now) => now.target.join() !== start.target.join()],
    ['+', (now) => now.radius < start.radius],
  ]) {
    await page.keyboard.press(key);
    await frames(page, 3);
    assert.ok(changed(await view()), key);
  }
  await page.keyboard.press('Home');
  await frames(page, 3);
  assert.ok(Math.abs((await view()).radius - start.radius) < 1e-3);
  assert.deepEqual(errors, []);
});

test('a lost GPU is made good', async (t) => {
  const { page } = await openView(t);
  const before = await picture(page);
  await page.evaluate(async () => {
    const canvas = document.querySelector('lightwell-view').shadowRoot.querySelector('canvas');
    const extension = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
    const event = (name) => new Promise((resolve) => canvas.addEventListener(name, resolve, { once: true }));
    const lost = event('webglcontextlost');
    extension.loseContext();
    await lost;
    await new Promise((resolve) => setTimeout(resolve));
    const restored = event('webglcontextrestored');
    extension.restoreContext();
    await restored;
  });
  await frames(page, 3);
  assert.equal(await picture(page), before);
});

test('each light can be turned off', async (t) => {
  const { page, errors } = await openView(t);
  const pictures = new Set();
  for (const light of ['all', 'direct', 'indirect', 'off']) {
    await page.evaluate((value) => document.querySelector('lightwell-view').setAttribute('light', value), light);
    pictures.add(await picture(page));
  }
  assert.ok(pictures.size >= 2);
  assert.deepEqual(errors, []);
});

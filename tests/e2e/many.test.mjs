// SPDX-License-Identifier: Apache-2.0
//
// More elements on a page than a browser has WebGL contexts for.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';

const COUNT = 20;
/** Contexts at once, as web/README.md says. */
const MOST = 12;
const MOST_ON_A_PHONE = 6;
/** The shade, of 255, in the middle of a picture that is not blank. */
const LIT = 10;
/** Many loads, in software. */
const LONG = 240_000;

/** Runs in the page before its scripts: `contexts` are those that are not lost, `most` how many there were at once. */
const COUNT_CONTEXTS = `globalThis.contexts = new Set();
globalThis.most = 0;
const { getContext } = HTMLCanvasElement.prototype;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  const context = getContext.call(this, kind, ...rest);
  if (kind === 'webgl2') contexts.add(context);
  for (const other of contexts) if (other.isContextLost()) contexts.delete(other);
  globalThis.most = Math.max(most, contexts.size);
  return context;
};`;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 1_000);
const browser = await forAllTests(launch());

/** COUNT elements, the first half eager and the second lazy, of some style. */
async function openMany(t, style, options = {}) {
  const views = Array.from({ length: COUNT }, (_, i) =>
    `<lightwell-view src="pack.lw.glb" camera-controls loading="${i < COUNT / 2 ? 'eager' : 'lazy'}" style="${style}"></lightwell-view>`);
  const server = await forTest(t, startStaticServer({ ...(await elementPage(views.join(''))), '/pack.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser, { width: 640, height: 480, init: COUNT_CONTEXTS, ...options }));
  const warnings = [];
  page.on('console', (message) => /WebGL/.test(message.text()) && warnings.push(message.text()));
  await page.goto(server.url);
  await page.evaluate(() => (globalThis.views = [...document.querySelectorAll('lightwell-view')]));
  return { page, errors, warnings };
}

/** Waits until an element shows a picture, its own or one that stands for it, which is not blank in the middle. */
const shown = (page, index) =>
  page.waitForFunction(
    ([i, lit]) => {
      const view = views[i];
      view.draw();
      const canvas = view.shadowRoot.querySelector('canvas');
      if (canvas === null || (!view.complete && !canvas.classList.contains('poster'))) return false;
      const pixel = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d');
      pixel.drawImage(canvas, canvas.width / 2, canvas.height / 2, 1, 1, 0, 0, 1, 1);
      return Math.max(...pixel.getImageData(0, 0, 1, 1).data.slice(0, 3)) > lit;
    },
    [index, LIT],
    { timeout: LONG },
  );

test('each is there when the visitor comes to it, and again when he comes back', { timeout: LONG }, async (t) => {
  const { page, errors, warnings } = await openMany(t, 'height: 400px; margin: 300px 0');
  await shown(page, 0);
  await page.evaluate(() => (views[0].view = { ...views[0].view, theta: 1 }));
  for (const i of [...Array(COUNT).keys(), 0]) {
    await page.evaluate((index) => views[index].scrollIntoView({ block: 'center' }), i);
    await page.waitForFunction((index) => views[index].complete, i, { timeout: LONG });
    await shown(page, i);
  }
  assert.ok(Math.abs((await page.evaluate(() => views[0].view.theta)) - 1) < 1e-6, 'the view was lost');
  assert.ok((await page.evaluate(() => globalThis.most)) <= MOST);
  assert.deepEqual(warnings, []);
  assert.deepEqual(errors, []);
});

test('lazy ones take no context before the visitor comes near', async (t) => {
  const { page } = await openMany(t, 'height: 400px; margin: 300px 0');
  await shown(page, 0);
  assert.equal(await page.evaluate((half) => views.slice(half).filter(({ shadowRoot }) => shadowRoot.querySelector('canvas')).length, COUNT / 2), 0);
});

test('all of them on the screen: none is blank, and one that is touched becomes alive', { timeout: LONG }, async (t) => {
  const { page, errors, warnings } = await openMany(t, 'display: inline-block; width: 100px; height: 80px; min-height: 0');
  for (let i = 0; i < COUNT; i++) await shown(page, i);
  assert.ok((await page.evaluate(() => globalThis.most)) <= MOST);
  const still = await page.waitForFunction(() => views.find(({ loaded }) => !loaded));
  await still.asElement().hover();
  await page.waitForFunction((view) => view.complete, still);
  assert.deepEqual(warnings, []);
  assert.deepEqual(errors, []);
});

test('a phone has fewer', { timeout: LONG }, async (t) => {
  const { page, errors } = await openMany(t, 'display: inline-block; width: 100px; height: 80px; min-height: 0', { isMobile: true, hasTouch: true });
  for (let i = 0; i < COUNT; i++) await shown(page, i);
  assert.ok((await page.evaluate(() => globalThis.most)) <= MOST_ON_A_PHONE);
  assert.deepEqual(errors, []);
});

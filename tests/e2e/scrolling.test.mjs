// SPDX-License-Identifier: Apache-2.0
//
// An element in the middle of a long page: what scrolls the page and what moves the camera.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { openFingers } from './fingers.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 1_000);
const SIZE = { width: 200, height: 400 };

const browser = await forAllTests(launch());

/** The element with attributes, under a paragraph and above a long way down. */
async function openArticle(t, attributes) {
  const body = `<p>Above.</p><lightwell-view src="pack.lw.glb" ${attributes} style="height: 300px"></lightwell-view><p style="height: 3000px">`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/pack.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser, { ...SIZE, hasTouch: true }));
  await page.goto(server.url);
  await complete(page);
  const state = () => page.evaluate(() => ({ view: document.querySelector('lightwell-view').view, scrolled: scrollY }));
  const start = await state();
  /** Waits until the page has scrolled, or until the view fulfils a condition on what it was. */
  const scrolled = () => page.waitForFunction(() => scrollY > 0);
  const changed = (part) =>
    page.waitForFunction(
      ([name, before]) => JSON.stringify(document.querySelector('lightwell-view').view[name]) !== before,
      [part, JSON.stringify(start.view[part])],
    );
  await page.mouse.move(SIZE.width / 2, SIZE.height / 2);
  return { page, errors, start, state, scrolled, changed, fingers: await openFingers(page, SIZE) };
}

test('the wheel scrolls the page until the element has been clicked, then it zooms', async (t) => {
  const { page, start, state, scrolled, changed, errors } = await openArticle(t, 'camera-controls');
  await page.mouse.wheel(0, 50);
  await scrolled();
  assert.deepEqual((await state()).view, start.view);
  const { scrolled: at } = await state();
  await page.mouse.click(SIZE.width / 2, SIZE.height / 2);
  await page.mouse.wheel(0, 50);
  await changed('radius');
  assert.equal((await state()).scrolled, at);
  assert.deepEqual(errors, []);
});

test('with camera-controls="always" the wheel zooms at once', async (t) => {
  const { page, state, changed } = await openArticle(t, 'camera-controls="always"');
  await page.mouse.wheel(0, 50);
  await changed('radius');
  assert.equal((await state()).scrolled, 0);
});

test('without camera-controls the wheel scrolls, though the element has been clicked', async (t) => {
  const { page, start, state, scrolled } = await openArticle(t, '');
  await page.mouse.click(SIZE.width / 2, SIZE.height / 2);
  await page.mouse.wheel(0, 50);
  await scrolled();
  assert.deepEqual((await state()).view, start.view);
});

test('a finger that goes up scrolls the page', async (t) => {
  const { fingers, start, state, scrolled, errors } = await openArticle(t, 'camera-controls');
  await fingers.move({ from: [0.5, 0.7], to: [0.5, 0.3] });
  await scrolled();
  assert.deepEqual((await state()).view, start.view);
  assert.deepEqual(errors, []);
});

test('a finger that goes sideways turns the scene, and the page stays', async (t) => {
  const { fingers, state, changed } = await openArticle(t, 'camera-controls');
  await fingers.move({ from: [0.2, 0.5], to: [0.8, 0.45] });
  await changed('theta');
  assert.equal((await state()).scrolled, 0);
});

test('two fingers that go up move the scene, and the page stays', async (t) => {
  const { fingers, state, changed } = await openArticle(t, 'camera-controls');
  await fingers.move({ from: [0.3, 0.7], to: [0.3, 0.4] }, { from: [0.7, 0.7], to: [0.7, 0.4] });
  await changed('target');
  assert.equal((await state()).scrolled, 0);
});

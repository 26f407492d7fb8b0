// SPDX-License-Identifier: Apache-2.0
//
// The page's tiles of packs: pictures of those that were shown, and of the others as they begin.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { complete } from './view.mjs';

/** Of a picture, in bytes: a few kB. */
const MOST = 10_000;
/** Of 255: a picture that is not blank differs by so much within itself. */
const VARIED = 20;

const folder = temporaryFolder();
const packs = ['a room.lw.glb', 'lucy.lw.glb', 'new.lw.glb'].map((name, i) => ({ name, url: `packs/${i}.lw.glb` }));
packs.forEach((_, i) => writeSamplePack(`${folder}/${i}.lw.glb`, 2_000));
const browser = await forAllTests(launch());

async function openPacks(t, listed, options = {}) {
  const list = { text: JSON.stringify({ packs: listed }), type: 'application/json' };
  const server = await forTest(t, startStaticServer({ '/': `${WEB}dist`, '/packs/': folder, '/packs.json': list }));
  const opened = await forTest(t, openPage(browser, { width: 900, height: 700, ...options }));
  const scripts = [];
  opened.page.on('request', (request) => request.resourceType() === 'script' && scripts.push(new URL(request.url()).pathname));
  await opened.page.goto(server.url);
  await complete(opened.page);
  return { ...opened, scripts };
}

const pictures = (page) => page.locator('#tiles button').evaluateAll((tiles) => tiles.map((tile) => tile.querySelector('img') !== null));
const hasPictures = (page, wanted) =>
  page.waitForFunction(
    (expected) => [...document.querySelectorAll('#tiles button')].map((tile) => tile.querySelector('img') !== null).join() === expected,
    wanted.join(),
  );

/** How an image varies within itself, and how many bytes it has. */
const variety = (image) =>
  image.evaluate(async (element) => {
    await element.decode();
    const picture = Object.assign(document.createElement('canvas'), { width: 30, height: 20 }).getContext('2d');
    picture.drawImage(element, 0, 0, 30, 20);
    const green = [...picture.getImageData(0, 0, 30, 20).data].filter((_, i) => i % 4 === 1);
    return { bytes: element.src.length, range: Math.max(...green) - Math.min(...green) };
  });

const SAVES_DATA = `Object.defineProperty(navigator, 'connection', { value: { saveData: true } });`;
const KEEPS_NOTHING = `Object.defineProperty(globalThis, 'localStorage', { get() { throw new DOMException('no', 'SecurityError'); } });`;

test('a tile for each pack, with its picture, though it was not shown yet', async (t) => {
  const { page, errors } = await openPacks(t, packs);
  await hasPictures(page, [true, true, true]);
  for (const image of await page.locator('#tiles img').all()) {
    const { bytes, range } = await variety(image);
    assert.ok(bytes < MOST, `${bytes} bytes`);
    assert.ok(range > VARIED, `the picture is blank: ${range}`);
  }
  assert.equal(await page.locator('#tiles lightwell-view').count(), 0);
  await page.locator('#tiles').getByText('lucy').click();
  assert.equal(await page.locator('#tiles [aria-current=true]').textContent(), 'lucy');
  assert.equal(await page.locator('#packs').inputValue(), 'lucy');
  assert.match(page.url(), /#pack=lucy/);
  assert.deepEqual(errors, []);
});

test('a pack that is not there has a plain tile, and those behind it their pictures', async (t) => {
  const { page } = await openPacks(t, [packs[0], { name: 'gone.lw.glb', url: 'packs/gone.lw.glb' }, packs[1]]);
  await hasPictures(page, [true, false, true]);
});

test('a visitor who saves data fetches what he looks at', async (t) => {
  const { page } = await openPacks(t, packs, { init: SAVES_DATA });
  await hasPictures(page, [true, false, false]);
  await page.locator('#tiles').getByText('lucy').click();
  await hasPictures(page, [true, true, false]);
});

test('pictures are there when the page is opened again', async (t) => {
  const { page } = await openPacks(t, packs, { init: SAVES_DATA });
  await hasPictures(page, [true, false, false]);
  // An address that is changed by hand is loaded anew.
  await page.evaluate(() => void (location.hash = '#pack=new'));
  await page.waitForFunction(() => document.title.startsWith('new') && document.querySelector('#tiles') !== null);
  assert.deepEqual((await pictures(page)).slice(0, 2), [true, false]);
  await hasPictures(page, [true, false, true]);
});

test('where the browser keeps nothing, tiles have pictures for as long as the page is open', async (t) => {
  const { page, errors } = await openPacks(t, packs, { init: KEEPS_NOTHING });
  await hasPictures(page, [true, true, true]);
  assert.deepEqual(errors, []);
});

test('one pack alone has no tiles, and their script is not fetched', async (t) => {
  const { page, scripts } = await openPacks(t, packs.slice(0, 1));
  await page.waitForTimeout(500);
  assert.equal(await page.locator('#tiles').count(), 0);
  assert.ok(!scripts.some((path) => /tiles/.test(path)), `${scripts}`);
});

// SPDX-License-Identifier: Apache-2.0
//
// Which pack the page shows, and what its address says of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { loaded, notice } from './view.mjs';

const folder = temporaryFolder();
const packs = ['a room.lw.glb', 'lucy.lw.glb'].map((name, i) => ({ name, url: `packs/${i}.lw.glb` }));
packs.forEach((_, i) => writeSamplePack(`${folder}/${i}.lw.glb`, 2_000));

const browser = await forAllTests(launch());
const server = await forAllTests(startStaticServer({
  '/': `${WEB}dist`,
  '/packs/': folder,
  '/packs.json': { text: JSON.stringify({ packs }), type: 'application/json' },
}));

async function openHash(t, hash) {
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url + hash);
  return opened;
}

/** What the page shows by file, title and address, once it is there. */
async function shown(page) {
  await loaded(page);
  return page.evaluate(() => [
    document.querySelector('lightwell-view').getAttribute('src'),
    document.title,
    new URLSearchParams(location.hash.slice(1)).get('pack'),
  ]);
}

const ROOM = ['packs/0.lw.glb', 'a room · Lightwell', 'a room.lw.glb'];
const LUCY = ['packs/1.lw.glb', 'lucy · Lightwell', 'lucy.lw.glb'];

for (const [hash, expected] of [['', ROOM], ['#pack=', ROOM], ['#pack=a%20room', ROOM], ['#pack=lucy', LUCY], ['#pack=lucy.lw.glb', LUCY],
  ['?pack=lucy', LUCY], ['?pack=lucy#pack=a%20room', ROOM]])
  test(`an address that ends in '${hash}' shows ${expected[2]} and names it`, async (t) => {
    const { page } = await openHash(t, hash);
    assert.deepEqual(await shown(page), expected);
  });

test('a pack that the server does not have is said, and another one can be chosen', async (t) => {
  const { page, errors } = await openHash(t, '#pack=lucie');
  await notice(page, 'no pack .lucie');
  assert.equal(await page.evaluate(() => document.querySelector('lightwell-view').getAttribute('src')), null);
  await page.selectOption('#packs', 'lucy');
  assert.deepEqual(await shown(page), LUCY);
  await notice(page, '');
  assert.deepEqual(errors, []);
});

/** The page's view, with as many digits as its address has. */
const view = (page) =>
  page.evaluate(() => {
    const { theta, phi, radius, target } = document.querySelector('lightwell-view').view;
    return [theta, phi, radius, ...target].map((number) => Number(number.toFixed(4)));
  });

const VIEW = [0.5, 1.25, 2.5, 0.1, 0.2, 0.3];

test('the view of an address is shown', async (t) => {
  const { page } = await openHash(t, `#pack=lucy&view=${VIEW}`);
  assert.deepEqual(await shown(page), LUCY);
  assert.deepEqual(await view(page), VIEW);
});

test('a view in the query is shown, too', async (t) => {
  const { page } = await openHash(t, `?pack=lucy&view=${VIEW}`);
  assert.deepEqual(await shown(page), LUCY);
  assert.deepEqual(await view(page), VIEW);
});

test('the view of a pack that the server does not have is not given to another one', async (t) => {
  const { page } = await openHash(t, `#pack=gone&view=${VIEW}`);
  await notice(page, 'no pack .gone');
  await page.selectOption('#packs', 'lucy');
  assert.deepEqual(await shown(page), LUCY);
  const own = await view(page);
  const { page: plain } = await openHash(t, '#pack=lucy');
  await loaded(plain);
  assert.deepEqual(own, await view(plain));
});

test('an address that is changed by hand is shown, though the camera moves meanwhile', async (t) => {
  const { page } = await openHash(t, '#pack=lucy');
  await loaded(page);
  await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    location.hash = '#pack=a%20room';
    view.dispatchEvent(new CustomEvent('camera-change', { detail: view.view }));
  });
  await page.waitForFunction(() => document.title.startsWith('a room'));
  assert.deepEqual(await shown(page), ROOM);
});

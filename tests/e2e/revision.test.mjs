// SPDX-License-Identifier: Apache-2.0
//
// Another three.js than the one whose shaders Lightwell knows.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { three, WEB } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/room.lw.glb`, 1_000);
const browser = await forAllTests(launch());

/** The element with a three.js that says it is of the next revision. */
async function openNext(t, attributes) {
  const next = String(Number(three.REVISION) + 1);
  const routes = await elementPage(`<lightwell-view src="room.lw.glb" ${attributes}></lightwell-view>`);
  const { text, type } = routes['/script.js'];
  const changed = text.replace(`REVISION = "${three.REVISION}"`, `REVISION = "${next}"`);
  assert.notEqual(changed, text);
  const server = await forTest(t, startStaticServer({ ...routes, '/script.js': { text: changed, type }, '/room.lw.glb': PACK }));
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url);
  return { ...opened, next };
}

test('is refused in the box and in one line of the console', async (t) => {
  const { page, errors, next } = await openNext(t, '');
  await page.getByText(`three.js ${next} is not ${three.REVISION}: pictures may be wrong`).waitFor();
  assert.equal(errors.length, 1, `${errors}`);
  assert.match(errors[0], new RegExp(`^lightwell-view: [^\n]*three.js ${next} is not [^\n]+$`));
  assert.equal(await page.evaluate(() => document.querySelector('lightwell-view').loaded), false);
});

test('is tried when the page says so', async (t) => {
  const { page, errors } = await openNext(t, 'any-three');
  await complete(page);
  assert.deepEqual(errors, []);
});

test('the package asks npm for the same', () => {
  const { peerDependencies } = JSON.parse(readFileSync(`${WEB}package.json`, 'utf8'));
  assert.equal(peerDependencies.three, `>=0.${three.REVISION} <0.${Number(three.REVISION) + 1}`);
});

// SPDX-License-Identifier: Apache-2.0
//
// What cannot be shown is said in words. What a server that goes away does stands in stream.test.mjs.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete, notice } from './view.mjs';

const folder = temporaryFolder();
const PACK = readFileSync(writeSamplePack(`${folder}/pack.lw.glb`, 5_000));
/** Of the sample's bytes, in the middle of a stream. */
const DAMAGED = PACK.length - 1000;

const browser = await forAllTests(launch());

/** The page with one pack, from a file that is put beside the good one or from another URL. */
async function openPack(t, { bytes, url = '/packs/broken.lw.glb', init } = {}) {
  if (bytes !== undefined) writeFileSync(`${folder}/broken.lw.glb`, bytes);
  const server = await forTest(t, startStaticServer({ ...viewerPage(url), '/packs/': folder }));
  const { page, errors } = await forTest(t, openPage(browser, { init }));
  await page.goto(server.url);
  return { page, errors };
}

/** The console holds one line of the element's. */
function assertOneLine(errors) {
  assert.equal(errors.length, 1, `${errors}`);
  assert.match(errors[0], /^lightwell-view: [^\n]+$/);
}

test('a file that is no pack', async (t) => {
  const { page, errors } = await openPack(t, { bytes: 'A letter, not a scene.'.repeat(100) });
  await notice(page, '^This scene cannot be shown.*broken.lw.glb: is no pack; `lightwell bake` makes one');
  assert.equal(await page.evaluate(() => document.querySelector('lightwell-view').loaded), false);
  assertOneLine(errors);
});

test('a file that is not there', async (t) => {
  const { page, errors } = await openPack(t, { url: '/packs/none.lw.glb' });
  await notice(page, '^This scene cannot be shown.*none.lw.glb: the server answers 404');
  assertOneLine(errors);
});

test('a file that is cut short', async (t) => {
  const { page, errors } = await openPack(t, { bytes: PACK.subarray(0, PACK.length / 2) });
  await notice(page, `^The rest of this scene cannot be shown.*has ${Math.floor(PACK.length / 2)} bytes, but should have ${PACK.length}`);
  assertOneLine(errors);
});

test('a file that is damaged: what has come stays', async (t) => {
  const bytes = Uint8Array.from(PACK);
  bytes[DAMAGED] ^= 1;
  const { page, errors } = await openPack(t, { bytes });
  await notice(page, '^The rest of this scene cannot be shown.*stream [0-9]+, block [0-9]+');
  assert.equal(await page.evaluate(() => document.querySelector('lightwell-view').loaded), true);
  assertOneLine(errors);
});

test('a server that lets no other site read it', async (t) => {
  const other = await forTest(t, startStaticServer({ '/packs/': folder }, { cors: () => false }));
  const { page } = await openPack(t, { url: `${other.url}packs/pack.lw.glb` });
  await notice(page, '^This scene cannot be shown.*does not let pages of other sites read it');
});

test('a server that lets other sites read by GET alone, and fails once', async (t) => {
  let asked = 0;
  const cors = ({ method }) => method === 'GET' && asked++ > 0;
  const other = await forTest(t, startStaticServer({ '/packs/': folder }, { cors }));
  const { page } = await openPack(t, { url: `${other.url}packs/pack.lw.glb` });
  await complete(page);
  assert.ok(asked > 1);
});

test('a server that is not there at first', async (t) => {
  const away = await startStaticServer({});
  await away.close();
  const { page } = await openPack(t, { url: `${away.url}packs/pack.lw.glb` });
  await notice(page, 'does not answer');
  const back = await forTest(t, startStaticServer({ '/packs/': folder }, { port: Number(new URL(away.url).port) }));
  await complete(page);
  await notice(page, '');
});

test('a browser without WebGL2', async (t) => {
  const { page, errors } = await openPack(t, {
    init: `{
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : getContext.call(this, kind, ...rest);
      };
    }`,
  });
  await notice(page, 'no WebGL2');
  assertOneLine(errors);
});

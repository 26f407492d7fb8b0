// SPDX-License-Identifier: Apache-2.0
//
// The picture of the page's light beside that which `lightwell render` makes of the same pack: tone curve off, Lambert materials.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { scriptPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** CIEDE2000; 1 is just visible. What remains are fetches with weights of 8 bits, and 8-bit colours. */
const MEAN = 0.5;
const P95 = 1;

const folder = temporaryFolder();
const PACK = bake('box-small', `${folder}/box.lw.glb`, { photons: 200_000, grid: 16 });
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test('indirect light looks as in lightwell render', async (t) => {
  const server = await startStaticServer({
    ...(await scriptPage('tests/e2e/pages/lambert.ts')),
    '/pack.lw.glb': PACK,
    '/worker.js': `${WEB}dist/worker.js`,
    '/lightwell.wasm': `${WEB}dist/lightwell.wasm`,
  });
  t.after(() => server.stop());
  const { page, errors, close } = await openPage(browser);
  t.after(close);
  await page.goto(server.url);
  await complete(page);
  const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
  writeFileSync(`${folder}/page.png`, Buffer.from(url.split(',')[1], 'base64'));
  const picture = ['--integrator', 'ivg', '--only', 'indirect', '--tone', 'none', '--size', '320x180', '--spp', '4'];
  lightwell('render', PACK, '-o', `${folder}/render.png`, ...picture);
  const { mean, p95 } = JSON.parse(lightwell('diff', `${folder}/render.png`, `${folder}/page.png`, '--metric', 'deltae', '--json'));
  assert.ok(mean <= MEAN && p95 <= P95, `mean ${mean}, 95th percentile ${p95}`);
  assert.deepEqual(errors, []);
});

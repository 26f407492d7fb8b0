// SPDX-License-Identifier: Apache-2.0
//
// The picture of the page's light beside that which `lightwell render` makes of the same pack: tone curve off, Lambert materials.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { CLIENT, scriptPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** CIEDE2000; 1 is just visible. What remains are fetches with weights of 8 bits, and 8-bit colours. */
const MEAN = 0.5;
const P95 = 1;

const folder = temporaryFolder();
const PACK = bake('box-small', `${folder}/box.lw.glb`, { photons: 200_000, grid: 16 });
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });

const browser = await forAllTests(launch());

test('indirect light looks as in lightwell render', async (t) => {
  const script = await scriptPage('tests/e2e/pages/lambert.ts');
  const server = await forTest(t, startStaticServer({ ...script, ...CLIENT, '/pack.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(`${server.url}?light=indirect`);
  await complete(page);
  const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
  writeFileSync(`${folder}/page.png`, Buffer.from(url.split(',')[1], 'base64'));
  const picture = ['--integrator', 'ivg', '--only', 'indirect', '--tone', 'none', '--size', '320x180', '--spp', '4'];
  lightwell('render', PACK, '-o', `${folder}/render.png`, ...picture);
  const { mean, p95 } = JSON.parse(lightwell('diff', `${folder}/render.png`, `${folder}/page.png`, '--metric', 'deltae', '--json'));
  assert.ok(mean <= MEAN && p95 <= P95, `mean ${mean}, 95th percentile ${p95}`);
  assert.deepEqual(errors, []);
});

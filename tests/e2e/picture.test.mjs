// SPDX-License-Identifier: Apache-2.0
//
// The page's pictures beside those that `lightwell render` makes of the same pack, tone curve off.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { BIN, temporaryFolder } from './packs.mjs';
import { startServe } from './servers.mjs';
import { complete } from './view.mjs';

/** CIEDE2000. 1 is just visible; fetches of 8-bit weights and the lamp's own pixels, white on the page only, remain. */
const INDIRECT_MEAN = 2;
const INDIRECT_P95 = 2;

const folder = temporaryFolder();
const pack = `${folder}/box.lw.glb`;
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
lightwell('bake', 'box-small', '-o', pack, '--photons', '200000', '--grid', '16');

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test('indirect light looks as in lightwell render', async (t) => {
  const server = await startServe(pack);
  t.after(() => server.stop());
  const { page, errors, close } = await openPage(browser);
  t.after(close);
  await page.goto(server.url);
  await complete(page);
  const url = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.setAttribute('tone', 'none');
    view.setAttribute('light', 'indirect');
    view.draw();
    return view.toDataURL();
  });
  writeFileSync(`${folder}/page.png`, Buffer.from(url.split(',')[1], 'base64'));
  const picture = ['--integrator', 'ivg', '--only', 'indirect', '--tone', 'none', '--size', '320x180', '--spp', '4'];
  lightwell('render', pack, '-o', `${folder}/render.png`, ...picture);
  const { mean, p95 } = JSON.parse(lightwell('diff', `${folder}/render.png`, `${folder}/page.png`, '--metric', 'deltae', '--json'));
  assert.ok(mean <= INDIRECT_MEAN && p95 <= INDIRECT_P95, `mean ${mean}, 95th percentile ${p95}`);
  assert.deepEqual(errors, []);
});

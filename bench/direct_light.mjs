// SPDX-License-Identifier: Apache-2.0
//
// direct_light.mjs PACK: how far the page's direct light, whose lamps are spot and point lights, is from that of `lightwell render
// --only direct`: CIEDE2000 over a picture of 320 x 180 without tone curve.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { BIN } from '../tests/e2e/packs.mjs';
import { startServe } from '../tests/e2e/servers.mjs';
import { complete } from '../tests/e2e/view.mjs';

/** A million triangles in software take their time, on a busy machine the more; milliseconds. */
const PATIENCE = 300_000;
/** Shadows are drawn anew at most twice a second, so the last ones come so much behind the last triangles; milliseconds. */
const LAST_SHADOWS = 600;

const pack = process.argv[2];
if (pack === undefined) throw new Error('usage: node bench/direct_light.mjs PACK');
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
const folder = mkdtempSync(join(tmpdir(), 'lightwell-direct-'));
const server = await startServe(pack);
const browser = await launch();
try {
  const { page } = await openPage(browser);
  await page.goto(server.url);
  await complete(page, PATIENCE);
  await page.waitForTimeout(LAST_SHADOWS);
  const url = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.setAttribute('tone', 'none');
    view.setAttribute('light', 'direct');
    return view.toDataURL();
  });
  const [shown, rendered] = ['page.png', 'render.png'].map((name) => join(folder, name));
  writeFileSync(shown, Buffer.from(url.split(',')[1], 'base64'));
  lightwell('render', pack, '-o', rendered, '--only', 'direct', '--tone', 'none', '--size', '320x180', '--spp', '16');
  const { mean, p95 } = JSON.parse(lightwell('diff', rendered, shown, '--metric', 'deltae', '--json'));
  console.log(JSON.stringify({ direct_light_deltae_mean: mean, direct_light_deltae_p95: p95 }));
} finally {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
}

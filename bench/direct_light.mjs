// SPDX-License-Identifier: Apache-2.0
//
// direct_light.mjs PACK [SAMPLES]: how far the page's direct light is from that of `lightwell render --only direct`, with so many samples a pixel
// (256 when it is left out): CIEDE2000 over a picture of 320 x 180 without tone curve, of the first frame, which has a shadow from each
// lamp's middle, and of the last, which has as many points of each lamp as it takes; by how many steps that are just not seen the page says that
// it may still be off; and how many seconds it took.
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
/** Of the GPU's time in a frame, milliseconds: samples come as fast as they can. */
const ALL_TIME = 10_000;

const [pack, samples = '256'] = process.argv.slice(2);
if (pack === undefined) throw new Error('usage: node bench/direct_light.mjs PACK [SAMPLES]');
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
const folder = mkdtempSync(join(tmpdir(), 'lightwell-direct-'));
const server = await startServe(pack);
const browser = await launch();
try {
  const { page } = await openPage(browser);
  await page.goto(server.url);
  await complete(page, PATIENCE);
  await page.waitForTimeout(LAST_SHADOWS);
  // What shines by itself is no direct light: `--only direct` has none of it.
  await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.setAttribute('tone', 'none');
    view.setAttribute('light', 'direct');
    view.pack.traverse(({ material }) => material?.emissive?.setScalar(0));
    view.setAttribute('shadows', 'hard');
  });
  const files = Object.fromEntries(['first', 'last', 'render'].map((name) => [name, join(folder, `${name}.png`)]));
  const shoot = async (file) => {
    const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
    writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
  };
  await shoot(files.first);
  const started = performance.now();
  const error = await page.evaluate(async (milliseconds) => {
    const { pack } = document.querySelector('lightwell-view');
    pack.setShadows('soft', milliseconds);
    while (pack.shadowSamples < Infinity) await new Promise(requestAnimationFrame);
    return pack.shadowError;
  }, ALL_TIME);
  const took = performance.now() - started;
  await shoot(files.last);
  lightwell('render', pack, '-o', files.render, '--only', 'direct', '--tone', 'none', '--size', '320x180', '--spp', samples);
  const against = (file) => JSON.parse(lightwell('diff', files.render, file, '--metric', 'deltae', '--json'));
  const [first, last] = [against(files.first), against(files.last)];
  const figures = {
    direct_light_first_deltae_mean: first.mean,
    direct_light_first_deltae_p95: first.p95,
    direct_light_deltae_mean: last.mean,
    direct_light_deltae_p95: last.p95,
    direct_light_error: error,
    direct_light_seconds: took / 1000,
  };
  console.log(JSON.stringify(figures));
} finally {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
}

// SPDX-License-Identifier: Apache-2.0
//
// direct_orbit.mjs PACK [SAMPLES] [FOLDER]: what is left of a view's shadows when the camera has gone around by 30 degrees from where it has rested:
// CIEDE2000 against `lightwell render --only direct`, with so many samples a pixel (256 when it is left out), over a picture of 320 x 180 without
// tone curve: of one that knows nothing (`hard`), of the first from the new place (`moved`), of the first that has new samples, too (`resting`), and of
// one at rest (`last`). The pictures are kept in the folder.
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

const [pack, samples = '256', kept] = process.argv.slice(2);
if (pack === undefined) throw new Error('usage: node bench/direct_orbit.mjs PACK [SAMPLES] [FOLDER]');
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
const folder = kept ?? mkdtempSync(join(tmpdir(), 'lightwell-orbit-'));
const server = await startServe(pack);
const browser = await launch();
try {
  const { page } = await openPage(browser);
  await page.goto(server.url);
  await complete(page, PATIENCE);
  await page.waitForTimeout(LAST_SHADOWS);
  const urls = await page.evaluate(async () => {
    const view = document.querySelector('lightwell-view');
    const { pack } = view;
    view.setAttribute('tone', 'none');
    view.setAttribute('light', 'direct');
    // What shines by itself is no direct light: `--only direct` has none of it.
    pack.traverse(({ material }) => material?.emissive?.setScalar(0));
    view.setAttribute('shadows', 'hard');
    const shown = { hard: view.toDataURL() };
    const end = view.view;
    const turned = (degrees) => (view.view = { ...end, theta: end.theta - (degrees * Math.PI) / 180 });
    const frame = () => new Promise(requestAnimationFrame);
    turned(30);
    // Of the GPU's time in a frame, milliseconds: samples come as fast as they can.
    pack.setShadows('soft', 10_000);
    while (pack.shadowSamples < Infinity) await frame();
    turned(0);
    shown.moved = view.toDataURL();
    while (pack.shadowSamples < 16) await frame();
    shown.resting = view.toDataURL();
    while (pack.shadowSamples < Infinity) await frame();
    shown.last = view.toDataURL();
    return shown;
  });
  const reference = join(folder, 'render.png');
  lightwell('render', pack, '-o', reference, '--only', 'direct', '--tone', 'none', '--size', '320x180', '--spp', samples);
  const figures = Object.entries(urls).flatMap(([name, url]) => {
    const file = join(folder, `${name}.png`);
    writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
    const { mean, p95 } = JSON.parse(lightwell('diff', reference, file, '--metric', 'deltae', '--json'));
    return [[`direct_orbit_${name}_deltae_mean`, mean], [`direct_orbit_${name}_deltae_p95`, p95]];
  });
  console.log(JSON.stringify(Object.fromEntries(figures)));
} finally {
  await browser.close();
  await server.close();
  if (kept === undefined) rmSync(folder, { recursive: true });
}

// SPDX-License-Identifier: Apache-2.0
//
// sky_lamp.mjs PACK [SAMPLES]: how far the page's picture of a pack whose sky is apart is from that of the path tracer, with so
// many samples a pixel (256 when it is left out): CIEDE2000 over the pixels of 640 x 360 that show the pack, without tone curve, by the
// grid alone, and at rest, when the sky is a lamp; and how long a direction took, in milliseconds.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { BIN } from '../tests/e2e/packs.mjs';
import { startServe } from '../tests/e2e/servers.mjs';
import { complete } from '../tests/e2e/view.mjs';

const [WIDTH, HEIGHT] = [640, 360];
/** A million triangles in software take their time, on a busy machine the more; milliseconds. */
const PATIENCE = 300_000;
/** Of the GPU's time in a frame, milliseconds: samples come as fast as they can. */
const ALL_TIME = 10_000;
const DIRECTIONS = 512;

const [pack, samples = '256'] = process.argv.slice(2);
if (pack === undefined) throw new Error('usage: node bench/sky_lamp.mjs PACK [SAMPLES]');
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
const folder = mkdtempSync(join(tmpdir(), 'lightwell-sky-'));
const files = Object.fromEntries(['grid', 'rest', 'path'].map((name) => [name, join(folder, `${name}.png`)]));
const server = await startServe(pack);
const browser = await launch();
try {
  lightwell('render', pack, '-o', files.path, '--tone', 'none', '--size', `${WIDTH}x${HEIGHT}`, '--spp', samples);
  const { page } = await openPage(browser, { width: WIDTH, height: HEIGHT });
  await page.goto(server.url);
  await complete(page, PATIENCE);
  await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.setAttribute('tone', 'none');
    view.setAttribute('environment-background', 'none');
    view.setAttribute('shadows', 'hard');
  });
  /** The page's picture over the path tracer's, and the part of the pixels that it covers. */
  const shoot = async (file) => {
    const path = `data:image/png;base64,${readFileSync(files.path).toString('base64')}`;
    const { url, part } = await page.evaluate(async (below) => {
      const read = async (src) => {
        const image = Object.assign(new Image(), { src });
        await image.decode();
        return image;
      };
      const canvas = Object.assign(document.createElement('canvas'), { width: innerWidth, height: innerHeight });
      const context = canvas.getContext('2d');
      const picture = await read(document.querySelector('lightwell-view').toDataURL());
      context.drawImage(picture, 0, 0);
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      const covered = data.filter((byte, i) => i % 4 === 3 && byte > 0).length;
      context.drawImage(await read(below), 0, 0);
      context.drawImage(picture, 0, 0);
      return { url: canvas.toDataURL(), part: covered / (canvas.width * canvas.height) };
    }, path);
    writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
    return part;
  };
  const part = await shoot(files.grid);
  const started = performance.now();
  await page.evaluate(async (milliseconds) => {
    const view = document.querySelector('lightwell-view');
    view.setAttribute('shadows', 'soft');
    view.pack.setShadows('soft', milliseconds);
    do await new Promise(requestAnimationFrame);
    while (view.pack.shadowSamples < Infinity);
  }, ALL_TIME);
  const took = performance.now() - started;
  await shoot(files.rest);
  const meanOf = (file) => JSON.parse(lightwell('diff', files.path, file, '--metric', 'deltae', '--json')).mean / part;
  const figures = {
    sky_lamp_part_of_picture: part,
    sky_lamp_grid_deltae_mean: meanOf(files.grid),
    sky_lamp_rest_deltae_mean: meanOf(files.rest),
    sky_lamp_ms_a_direction: took / DIRECTIONS,
  };
  console.log(JSON.stringify(figures));
} finally {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
}

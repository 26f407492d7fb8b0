// SPDX-License-Identifier: Apache-2.0
//
// look.mjs FOLDER [--environment R,G,B|FILE] SCENE...: what a user sees of a default bake: the page at rest and
// `render --integrator ivg`, each against the path tracer from the same camera, CIEDE2000 over 320 x 180 pixels,
// and the path tracer against itself with another seed, its noise; a row of a table a scene, and FOLDER/SCENE.png with the pictures side by side and four times the difference between page and path tracer. A
// scene without a lamp stands under a uniform sky, all do under an environment that is given.
import { execFileSync } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { BIN } from '../tests/e2e/packs.mjs';
import { startServe } from '../tests/e2e/servers.mjs';
import { putBeforeSky, writeSheet } from './sheet.mjs';
import { openPack, shoot, softenShadows } from './shot.mjs';

/** Samples a pixel; of `ivg` only the lamps' shadows have noise. */
const PATH_SAMPLES = 256;
const GRID_SAMPLES = 64;
/** After which a penumbra errs by less than 2 % (docs/results/direct.md), or as many as come in so many seconds. */
const SHADOW_POINTS = 64;
const SHADOW_SECONDS = 60;
const GAIN = 4;
const UNIFORM = '1,1,1';

const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet', '--json'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

/** Bakes a scene, under a uniform sky if it has no light of its own and no other is given; gives the bake's figures and the options of the sky. */
function bakeLit(scene, pack, environment) {
  const errors = [];
  for (const sky of environment === undefined ? [[], ['--environment', UNIFORM]] : [['--environment', environment]])
    try {
      return { sky, figures: JSON.parse(lightwell('bake', scene, '-o', pack, ...sky)) };
    } catch (error) {
      errors.push(error);
    }
  throw errors.at(-1);
}

/** Takes the pictures of a pack's page; gives the pack's exposure and how many points of each lamp the shadows are of. */
async function shootPage(browser, pack, files) {
  const server = await startServe(pack);
  const { page, close } = await openPage(browser);
  try {
    await openPack(page, server.url);
    const points = await softenShadows(page, SHADOW_POINTS, SHADOW_SECONDS);
    await shoot(page, files.page);
    // What shines by itself is no indirect light.
    const exposure = await page.evaluate(() => {
      const view = document.querySelector('lightwell-view');
      view.setAttribute('light', 'indirect');
      view.pack.traverse(({ material }) => material?.emissive?.setScalar(0));
      return view.pack.exposure;
    });
    await shoot(page, files.page_indirect);
    return { exposure, points };
  } finally {
    await close();
    await server.close();
  }
}

function difference(picture, reference) {
  const { mean, p95 } = JSON.parse(lightwell('diff', picture, reference, '--metric', 'deltae'));
  return `${mean.toFixed(2)} | ${p95.toFixed(1)}`;
}

/** A row of the table; the light straight from a sky is in the grid, so it is indirect there and direct in the path tracer. */
async function look(browser, scene, folder, environment) {
  const parts = join(folder, 'parts', basename(scene));
  mkdirSync(parts, { recursive: true });
  const names = ['page', 'ivg', 'path', 'again', 'page_indirect', 'path_indirect'];
  const files = Object.fromEntries(names.map((name) => [name, join(parts, `${name}.png`)]));
  const pack = join(parts, 'pack.lw.glb');
  const { sky, figures } = bakeLit(scene, pack, environment);
  const { exposure, points } = await shootPage(browser, pack, files);
  const view = ['--size', '320x180', '--exposure', String(exposure)];
  const path = ['--integrator', 'path', '--spp', String(PATH_SAMPLES), ...view, ...sky];
  lightwell('render', pack, '-o', files.ivg, '--integrator', 'ivg', '--spp', String(GRID_SAMPLES), ...view);
  lightwell('render', scene, '-o', files.path, ...path);
  lightwell('render', scene, '-o', files.again, ...path, '--seed', '2');
  const apart = !figures.grids.some(({ contains }) => contains.includes('environment'));
  if (sky[1] === UNIFORM) await putBeforeSky(browser, files.page, files.path);
  if (apart) lightwell('render', scene, '-o', files.path_indirect, '--only', 'indirect', ...path);
  await writeSheet(
    browser,
    join(folder, `${basename(scene)}.png`),
    [
      { label: `${basename(scene)}: page`, picture: files.page },
      { label: 'ivg', picture: files.ivg },
      { label: 'path', picture: files.path },
      { label: `${GAIN} x |page - path|`, picture: files.page, minus: files.path },
    ],
    GAIN,
  );
  const indirect = apart ? difference(files.page_indirect, files.path_indirect) : '- | -';
  const name = basename(scene) + (sky.length === 0 ? '' : sky[1] === UNIFORM ? ', uniform sky' : `, ${basename(sky[1])}`);
  const total = [files.page, files.ivg, files.again].map((file) => difference(file, files.path));
  return `| ${[name, points === Infinity ? 'all' : points, ...total, indirect].join(' | ')} |`;
}

const [folder, ...rest] = process.argv.slice(2);
const environment = rest[0] === '--environment' ? rest[1] : undefined;
const scenes = environment === undefined ? rest : rest.slice(2);
if (scenes.length === 0) throw new Error('usage: node bench/look.mjs FOLDER [--environment R,G,B|FILE] SCENE...');
const browser = await launch();
try {
  const pairs = ['page', 'ivg', 'noise', 'page, indirect'].map((what) => `${what}: mean | 95th percentile`);
  console.log(`| scene | points a lamp | ${pairs.join(' | ')} |\n|${'---|'.repeat(10)}`);
  for (const scene of scenes)
    console.log(await look(browser, scene, folder, environment).catch((error) => `| ${basename(scene)} | left out: ${String(error.stderr ?? error).trim()} |`));
} finally {
  await browser.close();
}

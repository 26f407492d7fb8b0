// SPDX-License-Identifier: Apache-2.0
//
// peer_shadows.mjs [SHEET]: soft shadows of a square lamp by Lightwell and by others of three.js's world, after equal numbers of points of
// the lamp: root mean square error, in percent, of the lamp's share that reaches a pixel of the floor, over the pixels that rays say to have between
// 2 and 98 % of it; behind it how many times Lightwell's it is. Each method's picture is divided by its own without shadows, so that shadows
// alone are held against one another. SHEET, a .png or .jpg, is a sheet of the pictures after 64 points.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { startStaticServer } from '../tests/e2e/static_server.mjs';
import { scriptPage } from '../tests/e2e/test_page.mjs';
import { scenesIn } from './peer_shadows/scenes.mjs';
import { sharesAt } from './peer_shadows/truth.mjs';
import { writeSheet } from './sheet.mjs';

const COUNTS = [16, 64, 256];
/** Which of them the sheet shows. */
const SHOWN = 1;
/** Rays of a first look, which finds penumbrae and is the sheet's truth, and of the truth, whose variance is taken off the error. */
const LOOK = 1024;
const RAYS = 16_384;
/** Pixels of penumbrae that are measured, at most, evenly over all. */
const MOST = 4000;
/** Of a penumbra. */
const [LEAST_SHARE, MOST_SHARE] = [0.02, 0.98];
/** A thousand shadow maps in software; milliseconds. */
const PATIENCE = 1_800_000;

/** Function of page.js, kind of its lights, numbers of points: PCSS has all from one, and what directional lights err by no number mends. */
const PEERS = [
  { title: 'ProgressiveLightMap', name: 'progressiveLightMap', kind: 'spot', counts: COUNTS },
  { title: 'AccumulativeShadows', name: 'accumulativeShadows', kind: 'spot', counts: COUNTS },
  { title: 'PCSS', name: 'pcss', counts: COUNTS },
  { title: 'ProgressiveLightMap, directional', name: 'progressiveLightMap', kind: 'directional', counts: COUNTS.slice(0, 2) },
  { title: 'AccumulativeShadows, directional', name: 'accumulativeShadows', kind: 'directional', counts: COUNTS.slice(0, 2) },
];

/** Of shares at some pixels against the truth at them, in percent. */
function errorOf(shares, truth) {
  const squares = truth.map(({ pixel, share, variance }) => (shares[pixel] - share) ** 2 - variance);
  return 100 * Math.sqrt(Math.max(0, squares.reduce((sum, x) => sum + x, 0) / squares.length));
}

/** The truth at pixels of penumbrae, and as a picture of the whole floor. */
function truthOf(scene, places) {
  const seen = places.flatMap((place, pixel) => (place === null ? [] : [{ place, pixel }]));
  const withShares = (some, rays) => {
    const shares = sharesAt(scene.file, scene.lamp, some.map(({ place }) => place), rays, folder);
    return some.map((of, i) => ({ ...of, ...shares[i] }));
  };
  const look = withShares(seen, LOOK);
  const close = look.filter(({ share, variance }) => share > 0 && 1 - share > 3 * Math.sqrt(variance));
  const step = Math.max(1, close.length / MOST);
  const some = Array.from({ length: Math.floor(close.length / step) }, (_, i) => close[Math.floor(i * step)]);
  const truth = withShares(some, RAYS).filter(({ share }) => share > LEAST_SHARE && share < MOST_SHARE);
  const picture = places.map(() => null);
  for (const { pixel, share } of look) picture[pixel] = share;
  return { truth, picture };
}

/** Prints the rows of a scene; gives the pictures by their titles. */
async function compare(page, { file, ...scene }) {
  const call = (name, ...values) => page.evaluate(([of, all]) => globalThis[of](...all), [name, [scene, ...values]]);
  const places = await call('places');
  const { truth, picture } = truthOf({ ...scene, file }, places);
  const [first, ...own] = await call('lightwell', COUNTS);
  const errors = own.map((shares) => errorOf(shares, truth));
  const print = (title, cells) => console.log(`| ${[scene.name, title, ...cells].join(' | ')} |`);
  print('Lightwell', errors.map((error) => error.toFixed(2)));
  print('Lightwell, first frame', [errorOf(first, truth).toFixed(2), '', '']);
  const pictures = [['rays', picture], ['Lightwell', own[SHOWN]]];
  for (const { title, name, kind, counts } of PEERS) {
    const shares = await call(name, counts, kind);
    const cells = shares.map((of, i) => `${errorOf(of, truth).toFixed(2)} (${(errorOf(of, truth) / errors[i]).toFixed(1)})`);
    print(title, COUNTS.map((_, i) => cells[i] ?? ''));
    if (kind !== 'directional') pictures.push([title, shares[SHOWN]]);
  }
  return pictures.map(([title, shares]) => [title, shares.map((share, i) => (places[i] === null ? null : share))]);
}

/** Writes a sheet with a column a method and a row a scene. */
async function writePictures(page, file, scenes) {
  const cells = [];
  for (const [i, [label]] of scenes[0].entries()) {
    const picture = join(folder, `${i}.png`);
    const url = await page.evaluate((stack) => globalThis.pictureOf(stack), scenes.map((pictures) => pictures[i][1]));
    writeFileSync(picture, Buffer.from(url.split(',')[1], 'base64'));
    cells.push({ label, picture });
  }
  await writeSheet(browser, file, cells);
}

const [sheet] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'lightwell-peers-'));
const server = await startStaticServer(await scriptPage('bench/peer_shadows/page.js'));
const browser = await launch();
try {
  const { page, errors } = await openPage(browser);
  page.setDefaultTimeout(PATIENCE);
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.pcss);
  console.log(`| scene | method | ${COUNTS.map((count) => `${count} points`).join(' | ')} |`);
  console.log(`|---|---|${COUNTS.map(() => '---|').join('')}`);
  const scenes = [];
  for (const scene of await scenesIn(folder)) scenes.push(await compare(page, scene));
  if (sheet !== undefined) await writePictures(page, sheet, scenes);
  if (errors.length > 0) throw new Error(errors.join('\n'));
} finally {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
}

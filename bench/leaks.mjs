// SPDX-License-Identifier: Apache-2.0
//
// leaks.mjs PARTS FOLDER REPORTED [CASE...]: rooms in which light that comes through a wall would be seen: FOLDER/leak_CASE.jpg has the
// lit side at the pack's own exposure, and the dark one, so many stops brighter, on the page and by the path tracer; a row of a table
// a case says how far those two are apart, CIEDE2000 over 320 x 180 pixels. PARTS takes the packs and single pictures; REPORTED is the
// folder of ../shared with what was reported.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { three } from '../tests/e2e/dependencies.mjs';
import { BIN } from '../tests/e2e/packs.mjs';
import { room, writeScene } from '../tests/e2e/scenes.mjs';
import { startServe } from '../tests/e2e/servers.mjs';
import { putBeforeSky, writeSheet } from './sheet.mjs';
import { openPack, shoot, softenShadows } from './shot.mjs';

const SIZE = ['--size', '320x180'];
const PATH_SAMPLES = 256;
const SHADOW_POINTS = 64;
const SHADOW_SECONDS = 60;
/** A thousandth of the light of the lit side looks as bright as that does. */
const THOUSANDTH = 10;

const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });

/** A bright room of 6 m, in it a closed box of 2.3 m with walls of 25 cm and no light inside (tests/bake/leak_test.cpp has its figures). */
function writeDarkBox(file) {
  const outside = room(1.15);
  outside.normals = outside.normals.map((x) => -x);
  outside.indices.reverse();
  const grey = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.5, 0.5, 0.5, 1] } };
  return writeScene(file, [
    { mesh: room(3), material: { ...grey, emissiveFactor: [1, 1, 1] } },
    { mesh: outside, material: grey },
    { mesh: room(0.9), material: grey },
  ]);
}

/** Where the cameras stand and what they look at; `stops` are those of the dark one beyond the lit one's exposure. */
const CASES = [
  {
    name: 'dark_box',
    scene: (folder) => writeDarkBox(join(folder, 'dark_box.gltf')),
    lit: [[2.6, 1.8, 2.6], [0, 0, 0]],
    dark: [[0.8, 0.6, 0.8], [-0.9, -0.5, -0.7]],
    stops: THOUSANDTH,
  },
  {
    name: 'two_rooms',
    scene: (folder) => (lightwell('scenes', 'two-rooms', '-o', join(folder, 'two_rooms.glb')), join(folder, 'two_rooms.glb')),
    lit: [[-3.6, 1.6, 0.5], [0, 1, 3]],
    dark: [[2.2, 1.2, 0.4], [0.2, 0.3, 2.6]],
    stops: 3,
  },
  {
    name: 'sheet_wall',
    scene: (folder, reported) => join(reported, '15-sheet-wall.glb'),
    lit: [[-1.6, 1.6, 1.6], [2, 1, -1]],
    dark: [[5.6, 1.6, 1.6], [2, 1, -1]],
    stops: THOUSANDTH,
  },
  {
    name: 'closed_room',
    scene: (folder, reported) => join(reported, '27-sheet-closed-lampless.glb'),
    sky: ['--environment', '1,1,1'],
    lit: [[5, 4, 7], [0, 1.5, 0]],
    dark: [[1.5, 1.8, 1.5], [-2, 1, -1]],
    stops: THOUSANDTH,
  },
];

/** A scene file's JSON with its buffer in it. */
function readScene(file) {
  const bytes = readFileSync(file);
  if (file.endsWith('.gltf')) return JSON.parse(bytes);
  const end = 20 + bytes.readUInt32LE(12);
  const gltf = JSON.parse(bytes.toString('utf8', 20, end));
  gltf.buffers[0].uri = `data:application/octet-stream;base64,${bytes.toString('base64', end + 8)}`;
  return gltf;
}

/** Writes a scene that is seen by two cameras, of which the lit one is the first, so that the exposure is for it. */
function writeWithCameras(file, gltf, { lit, dark }) {
  for (const node of gltf.nodes) delete node.camera;
  gltf.cameras = [];
  for (const [name, [place, target]] of Object.entries({ lit, dark })) {
    const matrix = new three.Matrix4().lookAt(new three.Vector3(...place), new three.Vector3(...target), new three.Vector3(0, 1, 0));
    const camera = gltf.cameras.push({ name, type: 'perspective', perspective: { yfov: 1, znear: 0.01 } }) - 1;
    gltf.scenes[0].nodes.push(gltf.nodes.push({ name, camera, matrix: matrix.setPosition(...place).toArray() }) - 1);
  }
  writeFileSync(file, JSON.stringify(gltf));
}

/** Takes the page's pictures of both sides; gives the dark one's exposure. */
async function shootSides(browser, pack, files, stops) {
  const server = await startServe(pack);
  const { page, close } = await openPage(browser);
  const lookThrough = (name) => page.evaluate((camera) => document.querySelector('lightwell-view').lookThrough(camera), name);
  try {
    await openPack(page, server.url);
    await lookThrough('lit');
    await softenShadows(page, SHADOW_POINTS, SHADOW_SECONDS);
    await shoot(page, files.lit);
    const exposure = await page.evaluate((more) => {
      const view = document.querySelector('lightwell-view');
      view.setAttribute('exposure', view.pack.exposure + more);
      return view.pack.exposure + more;
    }, stops);
    await lookThrough('dark');
    await softenShadows(page, SHADOW_POINTS, SHADOW_SECONDS);
    await shoot(page, files.dark);
    return exposure;
  } finally {
    await close();
    await server.close();
  }
}

async function show(browser, parts, folder, reported, { name, scene, sky = [], stops, ...cameras }) {
  const files = Object.fromEntries(['lit', 'sky', 'dark', 'path'].map((part) => [part, join(parts, `${name}.${part}.png`)]));
  const [seen, pack] = [join(parts, `${name}.seen.gltf`), join(parts, `${name}.lw.glb`)];
  writeWithCameras(seen, readScene(scene(parts, reported)), cameras);
  lightwell('bake', seen, '-o', pack, ...sky);
  const exposure = await shootSides(browser, pack, files, stops);
  const render = (file, camera, stop, samples) =>
    lightwell('render', seen, '-o', file, '--camera', camera, '--exposure', String(stop), '--spp', String(samples), ...SIZE, ...sky);
  render(files.path, 'dark', exposure, PATH_SAMPLES);
  if (sky.length > 0) {
    render(files.sky, 'lit', exposure - stops, 1);
    await putBeforeSky(browser, files.lit, files.sky);
  }
  await writeSheet(browser, join(folder, `leak_${name}.jpg`), [
    { label: 'lit side', picture: files.lit },
    { label: `dark side, ${stops} stops brighter`, picture: files.dark },
    { label: 'the same by the path tracer', picture: files.path },
  ]);
  const { mean, p95, max } = JSON.parse(lightwell('diff', files.dark, files.path, '--metric', 'deltae', '--json'));
  return `| ${name} | ${stops} | ${mean.toFixed(2)} | ${p95.toFixed(1)} | ${max.toFixed(1)} |`;
}

const [parts, folder, reported, ...only] = process.argv.slice(2);
if (reported === undefined) throw new Error('usage: node bench/leaks.mjs PARTS FOLDER REPORTED [CASE...]');
for (const path of [parts, folder]) mkdirSync(path, { recursive: true });
const browser = await launch();
try {
  console.log('| dark side of | stops | page against path tracer: mean | 95th percentile | largest |');
  console.log('|---|---|---|---|---|');
  for (const item of CASES.filter(({ name }) => only.length === 0 || only.includes(name)))
    console.log(await show(browser, parts, folder, reported, item));
} finally {
  await browser.close();
}

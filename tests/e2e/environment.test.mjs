// SPDX-License-Identifier: Apache-2.0
//
// What surrounds a scene, on the page: behind it, in mirrors, and not where something hides it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { BIN, bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

const SIZE = { width: 320, height: 180 };

const folder = temporaryFolder();

/** A Radiance picture: red grows to +x, green upwards, blue to -z, by which each direction is known. */
function writeSky(file, width = 256) {
  const height = width / 2;
  const pixels = [];
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const [azimuth, polar] = [2 * Math.PI * ((x + 0.5) / width - 0.5), (Math.PI * (y + 0.5)) / height];
      const direction = [Math.sin(polar) * Math.sin(azimuth), Math.cos(polar), Math.sin(polar) * Math.cos(azimuth)];
      // The mantissas of 0 to 2: an exponent of 2.
      pixels.push(...direction.map((along) => Math.round(64 * (1 + 0.9 * along))), 130);
    }
  const header = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`;
  writeFileSync(file, Buffer.concat([Buffer.from(header), Buffer.from(pixels)]));
  return file;
}

const metal = (roughnessFactor) => ({ pbrMetallicRoughness: { metallicFactor: 1, roughnessFactor, baseColorFactor: [0.9, 0.9, 0.9, 1] } });
const MATT = { pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1, baseColorFactor: [0.7, 0.7, 0.7, 1] } };

const sky = writeSky(`${folder}/sky.hdr`);
const scene = writeScene(`${folder}/balls.gltf`, [
  { mesh: sphere(0.4, 48), material: metal(0.05), at: [-1, 0, 0] },
  { mesh: sphere(0.4, 48), material: metal(0.5), at: [0, 0, 0] },
  { mesh: sphere(0.4, 48), material: MATT, at: [1, 0, 0] },
]);
const gltf = JSON.parse(readFileSync(scene, 'utf8'));
gltf.cameras = [{ type: 'perspective', perspective: { yfov: 0.5, znear: 0.1 } }];
gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0, 4] }) - 1);
writeFileSync(scene, JSON.stringify(gltf));
const pack = bake(scene, `${folder}/balls.lw.glb`, { environment: sky, grid: 'auto', 'target-error': 4 });

const browser = await forAllTests(launch());

async function open(t, attributes = '') {
  const element = `<lightwell-view src="pack.lw.glb" ${attributes} style="position: fixed; inset: 0"></lightwell-view>`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(element)), '/pack.lw.glb': pack }));
  const opened = await forTest(t, openPage(browser, SIZE));
  await opened.page.goto(server.url);
  await complete(opened.page);
  return opened;
}

const picture = (page) => page.evaluate(() => document.querySelector('lightwell-view').toDataURL());

/** The pixel at a place, shares of width and height: red, green, blue, alpha. */
const pixel = (page, place) =>
  page.evaluate(async ([x, y]) => {
    const image = new Image();
    image.src = document.querySelector('lightwell-view').toDataURL();
    await image.decode();
    const context = document.createElement('canvas').getContext('2d');
    context.canvas.width = image.width;
    context.canvas.height = image.height;
    context.drawImage(image, 0, 0);
    return [...context.getImageData(Math.round(x * image.width), Math.round(y * image.height), 1, 1).data];
  }, place);

test('what surrounds a scene is behind it and in what mirrors, as the path tracer has it', async (t) => {
  const { page, errors } = await open(t);
  const exposure = await page.evaluate(() => document.querySelector('lightwell-view').pack.exposure);
  writeFileSync(`${folder}/page.png`, Buffer.from((await picture(page)).split(',')[1], 'base64'));
  const options = ['--integrator', 'path', '--spp', '256', '--size', `${SIZE.width}x${SIZE.height}`, '--exposure', String(exposure), '--quiet'];
  execFileSync(`${BIN}/lightwell`, ['render', scene, '--environment', sky, '-o', `${folder}/path.png`, ...options]);
  const { mean, p95 } = JSON.parse(execFileSync(`${BIN}/lightwell`, ['diff', `${folder}/page.png`, `${folder}/path.png`, '--metric', 'deltae', '--json'], { encoding: 'utf8' }));
  // Steps of 3 % of the picture's bytes, and what a grid of few nodes errs by on the matt ball: less than can be seen beside each other.
  assert.ok(mean < 1 && p95 < 3, `mean ${mean}, 95th percentile ${p95}`);
  assert.deepEqual(errors, []);
});

test('the page may leave it out or blur it, and still mirrors it', async (t) => {
  const { page, errors } = await open(t, 'environment-background="none"');
  assert.equal((await pixel(page, [0.5, 0.05]))[3], 0);
  // The mirroring ball shows the sky behind the camera, +z, which has the least blue: more red and green on its right and its top.
  const right = await pixel(page, [0.5 - 1 / (4 * 2 * Math.tan(0.25) * (16 / 9)) + 0.04, 0.5]);
  assert.ok(right[0] > right[2], `${right}`);
  await page.evaluate(() => document.querySelector('lightwell-view').setAttribute('environment-background', 'blurred'));
  assert.equal((await pixel(page, [0.5, 0.05]))[3], 255);
  assert.equal(await page.evaluate(() => document.querySelector('lightwell-view').scene.backgroundBlurriness > 0), true);
  assert.deepEqual(errors, []);
});

test('without the baked light, which knows what hides it, nothing is mirrored', async (t) => {
  const { page, errors } = await open(t, 'light="off" environment-background="none"');
  assert.deepEqual((await pixel(page, [0.5, 0.5])).slice(0, 3), [0, 0, 0]);
  assert.deepEqual(errors, []);
});

test('what a page has put around the scene stays', async (t) => {
  const { page } = await open(t, 'environment-background="none"');
  const kept = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    const own = view.pack.environment.texture.clone();
    view.scene.background = own;
    view.setAttribute('environment-background', 'sharp');
    return view.scene.background === own;
  });
  assert.equal(kept, true);
});

test('a pack that is rendered without naming its environment shows it', async () => {
  const options = ['--spp', '16', '--size', '160x90', '--exposure', '0', '--quiet'];
  execFileSync(`${BIN}/lightwell`, ['render', pack, '-o', `${folder}/of_pack.png`, '--integrator', 'path', ...options]);
  execFileSync(`${BIN}/lightwell`, ['render', scene, '--environment', sky, '-o', `${folder}/of_scene.png`, '--integrator', 'path', ...options]);
  const { mean } = JSON.parse(execFileSync(`${BIN}/lightwell`, ['diff', `${folder}/of_pack.png`, `${folder}/of_scene.png`, '--metric', 'deltae', '--json'], { encoding: 'utf8' }));
  // Of the same noise, by the same seed: steps of 3 %.
  assert.ok(mean < 1, `${mean}`);
});

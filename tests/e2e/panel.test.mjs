// SPDX-License-Identifier: Apache-2.0
//
// The page's panel and its settings, which are fetched when they are unfolded.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { room, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete, loaded } from './view.mjs';

/** The file's cameras by name, with their places. */
const CAMERAS = { 'From the door': [0, 0, 0.9], 'Am Fenster': [0.5, 0.2, -0.5] };
/** Rounding. */
const SAME = 1e-6;

const folder = temporaryFolder();
const browser = await forAllTests(launch());

function packWithCameras() {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const file = writeScene(`${folder}/room.gltf`, [{ mesh: room(1), material }], [{ lamp: { type: 'point', intensity: 5 }, at: [0, 0.8, 0] }]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: 1, znear: 0.1 } }];
  for (const [name, translation] of Object.entries(CAMERAS))
    gltf.scenes[0].nodes.push(gltf.nodes.push({ name, camera: gltf.cameras.push(gltf.cameras[0]) - 1, translation }) - 1);
  gltf.cameras.shift();
  for (const node of gltf.nodes) if (node.camera !== undefined) node.camera--;
  writeFileSync(file, JSON.stringify(gltf));
  return bake(file, `${folder}/room.lw.glb`);
}

/** A room that a wall of 8 cm divides, which stands between nodes, with a lamp on each side. */
function packWithAWall() {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const wall = room(1);
  wall.positions = wall.positions.map((x, i) => (i % 3 === 0 ? 0.04 * x - 0.571 : x));
  wall.normals = wall.normals.map((x) => -x);
  wall.indices.reverse();
  const lamp = { type: 'point', intensity: 5 };
  const lamps = [{ lamp, at: [0.3, 0.8, 0] }, { lamp, at: [-0.8, 0.8, 0] }];
  const file = writeScene(`${folder}/wall.gltf`, [{ mesh: room(1), material }, { mesh: wall, material }], lamps);
  return bake(file, `${folder}/wall.lw.glb`);
}

const PACK = packWithCameras();

async function openViewer(t, size, pack = PACK) {
  const server = await forTest(t, startStaticServer({ ...viewerPage('/room.lw.glb'), '/room.lw.glb': pack }));
  const opened = await forTest(t, openPage(browser, size));
  const scripts = [];
  opened.page.on('request', (request) => request.resourceType() === 'script' && scripts.push(new URL(request.url()).pathname));
  await opened.page.goto(server.url);
  return { ...opened, scripts, url: server.url };
}

const WIDE = { width: 900, height: 700 };

async function openSettings(page) {
  await page.getByText('Settings').click();
  await page.locator('#exposure').waitFor();
}

test('the panel is folded on a phone and unfolded where there is room', async (t) => {
  const phone = await openViewer(t, { width: 390, height: 780, hasTouch: true, isMobile: true });
  await loaded(phone.page);
  assert.equal(await phone.page.locator('#geometry').isVisible(), false);
  await phone.page.locator('#title').tap();
  await phone.page.locator('#geometry').waitFor();
  const desk = await openViewer(t, WIDE);
  await desk.page.locator('#geometry').waitFor();
});

test('the settings’ script is fetched when they are unfolded, and knows what is shown', async (t) => {
  const { page, scripts, errors } = await openViewer(t, WIDE);
  await complete(page);
  assert.ok(!scripts.some((path) => /settings/.test(path)), `${scripts}`);
  await openSettings(page);
  const exposure = await page.evaluate(() => document.querySelector('lightwell-view').pack.exposure);
  assert.ok(Math.abs(Number(await page.locator('#exposure').inputValue()) - exposure) <= 0.05);
  await page.getByLabel('Direct light', { exact: true }).uncheck();
  assert.equal(await page.locator('lightwell-view').getAttribute('light'), 'indirect');
  await page.getByLabel('Wireframe').check();
  assert.equal(await page.locator('lightwell-view').getAttribute('wireframe'), '');
  assert.deepEqual(errors, []);
});

test('the file’s cameras are offered by their names, and looked through', async (t) => {
  const { page } = await openViewer(t, WIDE);
  await loaded(page);
  await openSettings(page);
  assert.deepEqual(await page.locator('#cameras option').allTextContents(), Object.keys(CAMERAS));
  for (const [name, place] of Object.entries(CAMERAS).reverse()) {
    await page.selectOption('#cameras', name);
    const position = await page.evaluate(() => document.querySelector('lightwell-view').camera.position.toArray());
    position.forEach((value, axis) => assert.ok(Math.abs(value - place[axis]) < SAME, `${name}: ${position}`));
  }
});

test('the visitor walks when the box is ticked, and circles again when it is not', async (t) => {
  const { page, scripts, errors } = await openViewer(t, WIDE);
  await complete(page);
  await openSettings(page);
  assert.ok(!scripts.some((path) => /extras/.test(path)), `${scripts}`);
  await page.getByLabel('Walk').check();
  const before = await page.evaluate(() => document.querySelector('lightwell-view').camera.position.toArray());
  await page.waitForFunction(() => document.querySelector('lightwell-view').shadowRoot.activeElement?.tabIndex === 0);
  const walked = () =>
    page.evaluate((place) => document.querySelector('lightwell-view').camera.position.toArray().join() !== place.join(), before);
  // The script is on its way, and a wall may be behind: keys are pressed until one is heard.
  for (let i = 0; !(await walked()) && i < 60; i++) {
    const key = ['KeyS', 'KeyW', 'KeyA', 'KeyD'][i % 4];
    await page.keyboard.down(key);
    await page.waitForTimeout(500);
    await page.keyboard.up(key);
  }
  assert.ok(await walked());
  await page.getByLabel('Walk').uncheck();
  assert.equal(await page.locator('lightwell-view').getAttribute('camera-controls'), 'always');
  assert.deepEqual(errors, []);
});

test('a picture is saved, and links and HTML are copied', async (t) => {
  const { page, url, errors } = await openViewer(t, WIDE);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await complete(page);
  await openSettings(page);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByText('Save picture').click()]);
  assert.equal(download.suggestedFilename(), 'room.png');
  assert.equal(readFileSync(await download.path()).subarray(1, 4).toString(), 'PNG');
  const copied = async (button) => {
    await page.getByText(button).click();
    await page.getByText('is copied').waitFor();
    return page.evaluate(() => navigator.clipboard.readText());
  };
  assert.equal(await copied('Copy link'), page.url());
  const html = await copied('Copy HTML');
  assert.match(html, new RegExp(`^<lightwell-view src="${url}room.lw.glb" camera-controls camera-orbit="[^"]+rad [^"]+rad [^"]+m" camera-target=`));
  assert.deepEqual(errors, []);
});

test('the page fills the screen and leaves it', async (t) => {
  const { page, errors } = await openViewer(t, WIDE);
  await loaded(page);
  await openSettings(page);
  await page.getByText('Full screen').click();
  await page.waitForFunction(() => document.fullscreenElement !== null);
  await page.getByText('Full screen').click();
  await page.waitForFunction(() => document.fullscreenElement === null);
  assert.deepEqual(errors, []);
});

test('the cells and nodes of the light can be seen, and are gone again', async (t) => {
  const { page, errors } = await openViewer(t, WIDE);
  await complete(page);
  await openSettings(page);
  const shown = () =>
    page.evaluate(() => {
      const { pack } = document.querySelector('lightwell-view');
      return pack.children.filter(({ isMesh }) => isMesh).map(({ geometry }) => geometry.attributes.position.count);
    });
  await page.getByLabel('Cells of light').check();
  assert.deepEqual(await shown(), [8], 'a regular grid is one box');
  await page.getByLabel('Nodes of light').check();
  const nodes = await page.evaluate(() => document.querySelector('lightwell-view').progress.nodes.total);
  const [, ...stones] = await shown();
  assert.equal(stones.reduce((sum, count) => sum + count, 0), 6 * nodes, 'an octahedron for each node');
  await page.getByLabel('Cells of light').uncheck();
  await page.getByLabel('Nodes of light').uncheck();
  assert.deepEqual(await shown(), []);
  assert.deepEqual(errors, []);
});

test('links that walls block are red lines through the wall', async (t) => {
  const { page, errors } = await openViewer(t, WIDE, packWithAWall());
  await complete(page);
  await openSettings(page);
  await page.getByLabel('Links that walls block').check();
  const lines = await page.waitForFunction(() => {
    const { pack } = document.querySelector('lightwell-view');
    const mesh = pack.children.find(({ isMesh }) => isMesh);
    return mesh && [...mesh.geometry.attributes.position.array];
  });
  const ends = await lines.jsonValue();
  assert.ok(ends.length > 0 && ends.length % 6 === 0);
  for (let i = 0; i < ends.length; i += 6) {
    const [x0, y0, z0, x1, y1, z1] = ends.slice(i, i + 6);
    assert.ok(x0 < -0.571 && x1 > -0.571 && y0 === y1 && z0 === z1, `${ends.slice(i, i + 6)} crosses the wall`);
  }
  await page.getByLabel('Links that walls block').uncheck();
  await page.waitForFunction(() => document.querySelector('lightwell-view').pack.children.every(({ isMesh }) => !isMesh));
  assert.deepEqual(errors, []);
});

test('the switches of measuring, comparing and of the raking light follow the element', async (t) => {
  const { page, errors } = await openViewer(t, WIDE);
  await complete(page);
  await openSettings(page);
  await page.getByLabel('Raking light').check();
  await page.getByRole('application').waitFor();
  await page.getByLabel('Raking light').uncheck();
  await page.getByRole('application').waitFor({ state: 'detached' });
  const line = page.getByRole('slider', { name: 'Without baked light' });
  await page.getByLabel('Compare').check();
  await line.waitFor();
  await page.getByLabel('Compare').uncheck();
  await line.waitFor({ state: 'detached' });
  assert.equal(await page.getByText('Animation').isVisible(), false, 'nothing moves in this pack');
  await page.getByLabel('Measure').check();
  // The script comes when it is wanted; the cursor tells that it is there.
  await page.waitForFunction(() => document.querySelector('lightwell-view').style.cursor === 'crosshair');
  await page.mouse.click(600, 200);
  await page.mouse.click(700, 400);
  await page.locator('lightwell-view output').filter({ hasText: / m$/ }).waitFor();
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !document.querySelector('#measure').checked);
  assert.deepEqual(errors, []);
});

/** What WCAG 2.1 asks of text of any size (1.4.3). */
const READABLE = 4.5;

for (const colorScheme of ['light', 'dark']) {
  test(`the panel is ${colorScheme} for who wants it, and can be read`, async (t) => {
    const server = await forTest(t, startStaticServer({ ...viewerPage('/room.lw.glb'), '/room.lw.glb': PACK }));
    const { page } = await forTest(t, openPage(browser, WIDE));
    await page.emulateMedia({ colorScheme });
    await page.goto(server.url);
    await complete(page);
    const { ground, contrasts } = await page.evaluate(() => {
      const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
      const over = (...colors) => {
        for (const color of colors) {
          canvas.fillStyle = color;
          canvas.fillRect(0, 0, 1, 1);
        }
        return [...canvas.getImageData(0, 0, 1, 1).data];
      };
      const luminance = (color) => {
        const [r, g, b] = color.slice(0, 3).map((x) => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const ratio = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
      const names = getComputedStyle(document.documentElement);
      const color = (name) => names.getPropertyValue(name);
      const panel = over(color('--ground'), color('--panel'));
      return {
        ground: luminance(over(color('--ground'))),
        contrasts: ['--text', '--quiet'].map((name) => [name, ratio(over(color(name)), panel)]),
      };
    });
    assert.equal(ground > 0.5, colorScheme === 'light', `${ground}`);
    for (const [name, contrast] of contrasts) assert.ok(contrast >= READABLE, `${name}: ${contrast}`);
  });
}

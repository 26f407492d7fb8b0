// SPDX-License-Identifier: Apache-2.0
//
// A camera stands where its author put it, however far away; the visitor comes back to it.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** Metres from a ball of one metre, and the camera's narrow angle in radians: the ball fills a good part of the height. */
const FAR = 100;
const NARROW = 0.03;
const AUTHORED = [0, 0, FAR];
/** Rounding, relative. */
const SAME = 1e-6;

const folder = temporaryFolder();
const browser = await forAllTests(launch());

function packWithCamera() {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const file = writeScene(`${folder}/ball.gltf`, [{ mesh: sphere(1), material }], [{ lamp: { type: 'directional', intensity: 3 }, at: AUTHORED }]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: NARROW, znear: 0.1 } }];
  gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: AUTHORED }) - 1);
  writeFileSync(file, JSON.stringify(gltf));
  return bake(file, `${folder}/ball.lw.glb`);
}

const PACK = packWithCamera();

async function openBall(t, attributes) {
  const body = `<lightwell-view src="pack.lw.glb" camera-controls="always" ${attributes} style="height: 160px"></lightwell-view>`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/pack.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await complete(page);
  const position = () => page.evaluate(() => document.querySelector('lightwell-view').camera.position.toArray());
  return { page, errors, position };
}

const assertAt = (position, place) =>
  position.forEach((value, axis) => assert.ok(Math.abs(value - place[axis]) < SAME * FAR, `${position} is not ${place}`));

test('a camera far away keeps its place, sees the scene, and is what Home returns to', async (t) => {
  const { page, errors, position } = await openBall(t, '');
  assertAt(await position(), AUTHORED);
  const shades = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.draw();
    const canvas = view.shadowRoot.querySelector('canvas');
    const picture = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
    const alphaAt = (x, y) => {
      picture.clearRect(0, 0, 1, 1);
      picture.drawImage(canvas, canvas.width * x, canvas.height * y, 1, 1, 0, 0, 1, 1);
      return picture.getImageData(0, 0, 1, 1).data[3];
    };
    return [alphaAt(0.5, 0.5), alphaAt(0.02, 0.02)];
  });
  assert.deepEqual(shades, [255, 0], 'the ball is not in the middle of the picture');
  await page.mouse.move(100, 80);
  await page.mouse.wheel(0, -300);
  await page.waitForFunction((far) => document.querySelector('lightwell-view').view.radius < 0.95 * far, FAR);
  await page.locator('lightwell-view').click();
  await page.keyboard.press('Home');
  assertAt(await position(), AUTHORED);
  assert.deepEqual(errors, []);
});

test('so does a distance that an attribute says', async (t) => {
  const { page } = await openBall(t, 'camera-orbit="0deg 90deg 500m"');
  const radius = await page.evaluate(() => document.querySelector('lightwell-view').view.radius);
  assert.ok(Math.abs(radius - 500) < SAME * 500, `${radius} m`);
});

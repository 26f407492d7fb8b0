// SPDX-License-Identifier: Apache-2.0
//
// The attribute animation: what moves in the file moves on the page, in the light of where it is.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage, viewerPage } from './test_page.mjs';
import { complete } from './view.mjs';

const SIZE = { width: 320, height: 180 };
/** Of the ball, along x; as the file stands, and at its animations' ends. */
const [REST, LEFT, RIGHT] = [0, -0.6, 0.6];
/** Milliseconds in which a few frames come; the animations take a second. */
const SHORT = 1500;

const folder = temporaryFolder();
const browser = await forAllTests(launch());

/** A ball in a room that is lit at its left. "slide" goes from the left to the right, "swell" opens the ball's morph target. */
function writeAnimated(file) {
  const diffuse = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.8, 0.8, 0.8, 1] } };
  const shapes = [{ mesh: room(1), material: diffuse }, { mesh: sphere(0.25), material: diffuse, at: [REST, 0, 0] }];
  writeScene(file, shapes, [{ lamp: { type: 'point', intensity: 0.5 }, at: [-0.8, 0.8, 0.5] }]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  const [prefix, old] = gltf.buffers[0].uri.split(',');
  let bytes = Buffer.from(old, 'base64');
  const accessor = (values, type, components, bounds = {}) => {
    const array = Float32Array.from(values);
    const bufferView = gltf.bufferViews.push({ buffer: 0, byteOffset: bytes.length, byteLength: array.byteLength }) - 1;
    bytes = Buffer.concat([bytes, Buffer.from(array.buffer)]);
    return gltf.accessors.push({ bufferView, componentType: 5126, count: values.length / components, type, ...bounds }) - 1;
  };
  const [ball] = gltf.meshes[1].primitives;
  const normals = gltf.accessors[ball.attributes.NORMAL];
  ball.targets = [{ POSITION: accessor(new Array(3 * normals.count).fill(0.1), 'VEC3', 3, { min: [0.1, 0.1, 0.1], max: [0.1, 0.1, 0.1] }) }];
  gltf.meshes[1].weights = [0];
  const input = accessor([0, 1], 'SCALAR', 1, { min: [0], max: [1] });
  const animation = (name, path, output) => ({ name, samplers: [{ input, output }], channels: [{ sampler: 0, target: { node: 1, path } }] });
  gltf.animations = [
    animation('slide', 'translation', accessor([LEFT, 0, 0, RIGHT, 0, 0], 'VEC3', 3)),
    animation('swell', 'weights', accessor([0, 1], 'SCALAR', 1)),
  ];
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: Math.PI / 2, znear: 0.1 } }];
  gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0, 0.95] }) - 1);
  Object.assign(gltf.buffers[0], { uri: `${prefix},${bytes.toString('base64')}`, byteLength: bytes.length });
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

const PACK = bake(writeAnimated(`${folder}/ball.gltf`), `${folder}/ball.lw.glb`);

async function open(t, attributes, { reducedMotion = 'no-preference' } = {}) {
  const body = `<lightwell-view src="ball.lw.glb" shadows="hard" ${attributes} style="position: absolute; inset: 0"></lightwell-view><p style="height: 3000px">`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/ball.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser, SIZE));
  await page.emulateMedia({ reducedMotion });
  await page.goto(server.url);
  await complete(page);
  await page.evaluate(() => {
    globalThis.view = document.querySelector('lightwell-view');
    view.pack.traverse((object) => object.morphTargetInfluences && (globalThis.ball = object));
  });
  return { page, errors };
}

const place = (page) => page.evaluate(() => ball.position.x);
const comes = (page, least, most) => page.waitForFunction(([a, b]) => ball.position.x > a && ball.position.x < b, [least, most]);

test('the first one is played, again and again, and at its end all is as it was', async (t) => {
  const { page, errors } = await open(t, 'animation');
  for (let round = 0; round < 2; round++) {
    await comes(page, LEFT, -0.2);
    await comes(page, 0.2, RIGHT);
  }
  await page.evaluate(() => view.removeAttribute('animation'));
  await page.waitForFunction(() => view.frameRate === 0);
  assert.equal(await place(page), REST);
  assert.deepEqual(errors, []);
});

test('one of a name is played; of one that is not there a line is said', async (t) => {
  const { page } = await open(t, 'animation="swell"');
  await page.waitForFunction(() => ball.morphTargetInfluences[0] > 0.3);
  assert.equal(await place(page), REST);
  const said = page.waitForEvent('console', (message) => message.text().includes('no animation "fly", but: slide, swell'));
  await page.evaluate(() => view.setAttribute('animation', 'fly'));
  await said;
  assert.equal(await page.evaluate(() => ball.morphTargetInfluences[0]), 0);
});

test('without the attribute, without motion, and out of sight nothing moves', async (t) => {
  const { page } = await open(t, '', { reducedMotion: 'reduce' });
  await page.waitForTimeout(SHORT);
  assert.equal(await place(page), REST);
  await page.evaluate(() => view.setAttribute('animation', ''));
  await page.waitForTimeout(SHORT);
  assert.equal(await place(page), REST);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  await comes(page, 0.2, RIGHT);
  await page.evaluate(() => scrollTo(0, 2000));
  await page.waitForTimeout(SHORT);
  const held = await place(page);
  await page.waitForTimeout(SHORT);
  assert.equal(await place(page), held);
});

/** The mean brightness of the ball above its middle, 0 to 255, while it is near a place. */
const brightness = (page, least, most) =>
  page.evaluate(
    ([from, to]) =>
      new Promise((resolve) => {
        view.addEventListener('frame', function look() {
          if (ball.position.x < from || ball.position.x > to) return;
          view.removeEventListener('frame', look);
          const seen = ball.getWorldPosition(ball.position.clone()).add({ x: 0, y: 0.18, z: 0.17 }).project(view.camera);
          const canvas = view.shadowRoot.querySelector('canvas');
          const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).getContext('2d');
          copy.drawImage(canvas, 0, 0);
          const [x, y] = [((1 + seen.x) / 2) * canvas.width, ((1 - seen.y) / 2) * canvas.height];
          const { data } = copy.getImageData(x - 4, y - 4, 8, 8);
          resolve(data.reduce((sum, value, i) => (i % 4 === 1 ? sum + value : sum), 0) / 64);
        });
      }),
    [least, most],
  );

test('it has the light of where it is', async (t) => {
  const { page } = await open(t, 'animation light="indirect"');
  const left = await brightness(page, LEFT, -0.4);
  const right = await brightness(page, 0.4, RIGHT);
  // By `lightwell probe`, indirect irradiance is half as strong again at the left: 1.43 towards the camera, 1.71 upwards.
  assert.ok(left > right + 10, `${left} at the left, ${right} at the right`);
});

test('the page has a switch for it where something moves', async (t) => {
  const server = await forTest(t, startStaticServer({ ...viewerPage('/ball.lw.glb'), '/ball.lw.glb': PACK }));
  const { page } = await forTest(t, openPage(browser, { width: 900, height: 600 }));
  await page.goto(server.url);
  await complete(page);
  await page.getByText('Settings').click();
  await page.getByLabel('Animation').check();
  await page.waitForFunction((rest) => {
    let moved = false;
    document.querySelector('lightwell-view').pack.traverse((object) => (moved ||= object.morphTargetInfluences !== undefined && Math.abs(object.position.x - rest) > 0.2));
    return moved;
  }, REST);
});

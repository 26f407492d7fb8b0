// SPDX-License-Identifier: Apache-2.0
//
// Direct and indirect light, each by itself, in a scene with a sun and a ball that shines. That ball and one that does not are
// two primitives of one mesh.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startServe } from './servers.mjs';
import { complete } from './view.mjs';

/** Shadows are drawn anew at most twice a second, so the last ones come so much behind the last triangles; milliseconds. */
const LAST_SHADOWS = 600;
/** Four roundings to 8 bits, each at most half a step of sRGB, which is 0.0045 of white where its curve is steepest. */
const ROUNDING = 0.018;
const SATURATED = 250;

const FLOOR = {
  positions: [-2, 0, 2, 2, 0, 2, 2, 0, -2, -2, 0, -2],
  normals: [0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0],
  texcoords: [0, 0, 1, 0, 1, 1, 0, 1],
  indices: [0, 1, 2, 0, 2, 3],
};
const WHITE = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.8, 0.8, 0.8, 1] } };
const SHINING = { ...WHITE, emissiveFactor: [1, 1, 1] };
const DOWN = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];
/** On the floor: in the shadow of the ball at (0, 1, 0), and in the sun. */
const IN_SHADOW = [0, 0, 0];
const IN_SUN = [-0.2, 0, 1];

const moved = (mesh, at) => ({ ...mesh, positions: mesh.positions.map((value, i) => value + at[i % 3]) });

/** Puts the second and the third shape of a scene into one mesh. */
function joinBalls(file) {
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.meshes[1].primitives.push(...gltf.meshes[2].primitives);
  gltf.scenes[0].nodes = gltf.scenes[0].nodes.filter((node) => node !== 2);
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

const folder = temporaryFolder();
const shapes = [
  { mesh: FLOOR, material: WHITE },
  { mesh: moved(sphere(0.3), [0, 1, 0]), material: WHITE },
  { mesh: moved(sphere(0.1), [1.2, 0.5, 0]), material: SHINING },
];
const scene = joinBalls(writeScene(`${folder}/balls.gltf`, shapes, [{ lamp: { type: 'directional', intensity: 2 }, at: [0, 3, 0], rotation: DOWN }]));
const pack = bake(scene, `${folder}/balls.lw.glb`);

const browser = await forAllTests(launch());

async function openBalls(t) {
  const server = await forTest(t, startServe(pack));
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url);
  await opened.page.evaluate(() => document.querySelector('lightwell-view').setAttribute('tone', 'none'));
  // Pictures are compared: shadows are to stay as they are.
  await opened.page.evaluate(() => document.querySelector('lightwell-view').setAttribute('shadows', 'hard'));
  await complete(opened.page);
  await opened.page.waitForTimeout(LAST_SHADOWS);
  return opened;
}

/** The bytes of a picture with one of the element's lights. */
const pixelsOf = (page, light) =>
  page.evaluate((value) => {
    const view = document.querySelector('lightwell-view');
    view.setAttribute('light', value);
    view.draw();
    const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
    const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return [...pixels];
  }, light);

/** Where the pixel of a point begins in such bytes. */
const placeOf = (page, point) =>
  page.evaluate(([x, y, z]) => {
    const { camera, shadowRoot } = document.querySelector('lightwell-view');
    const { width, height } = shadowRoot.querySelector('canvas');
    const { x: across, y: up } = camera.position.clone().set(x, y, z).project(camera);
    return 4 * (Math.floor(((up + 1) / 2) * height) * width + Math.floor(((across + 1) / 2) * width));
  }, point);

/** The light that a byte of sRGB stands for. */
const linear = (byte) => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

test('each light can be turned off, and together they are their sum', async (t) => {
  const { page, errors } = await openBalls(t);
  const place = await placeOf(page, IN_SUN);
  const pictures = {};
  for (const light of ['all', 'direct', 'indirect', 'off']) pictures[light] = await pixelsOf(page, light);
  const { all, direct, indirect, off } = pictures;
  assert.equal(off[place], 0, 'the floor has no light of its own');
  assert.ok(indirect[place] > 0 && direct[place] > indirect[place], `direct ${direct[place]}, indirect ${indirect[place]}`);
  assert.ok(off.some((byte, i) => i % 4 < 3 && byte > 0), 'the ball shines by itself');
  const shining = [0, 1, 2].map((channel) => off.reduce((most, byte, i) => (i % 4 === channel ? Math.max(most, byte) : most), 0));
  all.forEach((byte, i) => {
    if (i % 4 === 3 || byte > SATURATED) return;
    if (off[i] > 0 && off[i] < shining[i % 4]) return; // the edge of the ball: a mean of clipped light and of the floor
    const difference = linear(byte) + linear(off[i]) - linear(direct[i]) - linear(indirect[i]);
    assert.ok(Math.abs(difference) < ROUNDING, `byte ${i}: ${[byte, direct[i], indirect[i], off[i]]}`);
  });
  assert.deepEqual(errors, []);
});

test('of the mesh of a lamp only what shines casts no shadow', async (t) => {
  const { page, errors } = await openBalls(t);
  const casters = await page.evaluate(() => {
    const { pack } = document.querySelector('lightwell-view');
    const found = [];
    pack.opening.gltf.scene.traverse(({ isMesh, castShadow, material }) => {
      if (isMesh) found.push([material.emissive.r > 0, castShadow]);
    });
    return found;
  });
  assert.deepEqual(casters, [[false, true], [false, true], [true, false]]);
  const direct = await pixelsOf(page, 'direct');
  const [shadow, sun] = [await placeOf(page, IN_SHADOW), await placeOf(page, IN_SUN)].map((place) => linear(direct[place]));
  // The small ball lights the shadow a little.
  assert.ok(shadow < 0.3 * sun, `${shadow} in the shadow, ${sun} in the sun`);
  assert.deepEqual(errors, []);
});

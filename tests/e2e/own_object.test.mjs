// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { CLIENT, scriptPage } from './test_page.mjs';

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 5_000);

/** It has lamps, whose light the grid leaves out. */
const LAMPS = bake('box-small', `${folder}/lamps.lw.glb`);

const script = await scriptPage('web/examples/own_object.ts');
const browser = await forAllTests(launch());
const server = await forAllTests(startStaticServer({ ...script, ...CLIENT, '/pack.lw.glb': PACK, '/lamps.lw.glb': LAMPS }));

/** Opens the example and waits until its pack is complete. */
async function openExample(t, query = '') {
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url + query);
  await opened.page.waitForFunction(() => document.title === 'complete');
  await opened.page.evaluate(MEASURE);
  return opened;
}

/** Mean colour, in bytes, of the pixels of a picture in which only the knot is drawn. */
const MEASURE = `globalThis.knotColor = () => {
  const { renderer, scene, camera, knot, room } = globalThis;
  room.opening.gltf.scene.visible = false;
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const sum = [0, 0, 0];
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i] + pixels[i + 1] + pixels[i + 2] === 0) continue;
    count++;
    for (let c = 0; c < 3; c++) sum[c] += pixels[i + c];
  }
  return sum.map((value) => value / Math.max(count, 1));
};`;

test('an object of the user’s own is lit by the walls near it', async (t) => {
  const { page, errors } = await openExample(t);
  const [left, right] = await page.evaluate(() => [0, 1].map((place) => (globalThis.draw(place), globalThis.knotColor())));
  const ratio = ([red, green]) => red / green;
  assert.ok(left[0] > 5 && right[1] > 5, `too dark: ${left}, ${right}`);
  assert.ok(ratio(left) > 1.1 * ratio(right), `red side ${left}, green side ${right}`);
  assert.deepEqual(errors, []);
});

test('the lamps’ light follows when the room is scaled', async (t) => {
  const { page, errors } = await openExample(t, '?pack=lamps.lw.glb');
  const [before, after, back] = await page.evaluate(() => {
    const { room, knot, camera, draw, knotColor } = globalThis;
    for (const lamp of room.lamps) lamp.visible = true;
    for (const grid of room.grids) grid.visible = false;
    draw(0.2);
    const colors = [knotColor()];
    for (const factor of [3, 1 / 3]) {
      room.scale.multiplyScalar(factor);
      for (const object of [knot, camera]) {
        object.position.multiplyScalar(factor);
        object.scale.multiplyScalar(factor);
      }
      room.updateMatrixWorld(true);
      colors.push(knotColor());
    }
    return colors;
  });
  assert.ok(Math.max(...before) > 5, `too dark: ${before}`);
  // 8-bit colours, and the knot's outline.
  before.forEach((value, channel) => assert.ok(Math.abs(value - after[channel]) < 1.5, `${before} became ${after}`));
  before.forEach((value, channel) => assert.ok(Math.abs(value - back[channel]) < 1.5, `${before} became ${back}`));
  assert.deepEqual(errors, []);
});

test('a clone of a pack is refused in words', async (t) => {
  const { page } = await openExample(t);
  const message = await page.evaluate(() => {
    try {
      return String(globalThis.room.parent.clone());
    } catch (error) {
      return error.message;
    }
  });
  assert.match(message, /cannot be cloned.*load it again/);
});

test('a renderer that cannot show packs is refused in words', async (t) => {
  const { page } = await openExample(t);
  const message = await page.evaluate(() =>
    new globalThis.LightwellLoader().setRenderer({ isWebGPURenderer: true }).loadAsync('pack.lw.glb').catch((error) => error.message));
  assert.match(message, /WebGPURenderer/);
});

test('the grid follows its object when that is moved, turned and scaled', async (t) => {
  const { page, errors } = await openExample(t);
  const [before, after, left] = await page.evaluate(() => {
    const { room, knot, camera, scene, draw, knotColor } = globalThis;
    draw(0.2);
    const first = knotColor();
    room.position.set(7, -3, 2);
    room.rotation.set(0.3, 1.2, -0.4);
    room.scale.setScalar(2.5);
    room.updateMatrixWorld(true);
    for (const object of [knot, camera]) {
      object.updateMatrix();
      object.applyMatrix4(room.matrixWorld);
    }
    const moved = knotColor();
    room.visible = false;
    const alone = knotColor();
    room.visible = true;
    return [first, moved, alone];
  });
  // The same fragments but for rounding at the knot's outline; 8-bit colours.
  before.forEach((value, channel) => assert.ok(Math.abs(value - after[channel]) < 1.5, `${before} became ${after}`));
  assert.deepEqual(left, [0, 0, 0], 'without the room there is no light');
  assert.deepEqual(errors, []);
});

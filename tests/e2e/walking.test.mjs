// SPDX-License-Identifier: Apache-2.0
//
// Walking at eye height through a room.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { openFingers } from './fingers.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { room, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** Half the room's length, in metres: the floor is as far below the middle. */
const HALF = 3;
const EYE_HEIGHT = 1.65;
/** A body keeps so far from walls. */
const GIRTH = 0.3;
/** Coordinates of a pack are rounded; the way of one frame. */
const NEAR = 0.05;

const folder = temporaryFolder();
const browser = await forAllTests(launch());

function bakeRoom() {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const lamp = { lamp: { type: 'point', intensity: 50 }, at: [0, 2, 0] };
  return bake(writeScene(`${folder}/room.gltf`, [{ mesh: room(HALF), material }], [lamp]), `${folder}/room.lw.glb`);
}

const PACK = bakeRoom();

/** The room with the visitor in its middle, who looks along -z and walks. */
async function openRoom(t, options = {}) {
  const body = `<lightwell-view src="room.lw.glb" camera-controls camera-orbit="0deg 90deg 1m" camera-target="0m 0m -1m" style="height: 160px">`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/room.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser, options));
  await page.goto(server.url);
  await complete(page);
  await page.evaluate(() => {
    globalThis.view = document.querySelector('lightwell-view');
    globalThis.canvas = view.shadowRoot.querySelector('canvas');
    view.setAttribute('camera-controls', 'walk');
  });
  await page.waitForFunction(() => canvas.style.touchAction === 'none');
  await page.evaluate(() => canvas.focus());
  const place = () => page.evaluate(() => view.camera.position.toArray());
  /** Holds a key until a condition on the camera's place is fulfilled. */
  const hold = async (key, condition) => {
    await page.keyboard.down(key);
    await page.waitForFunction(condition);
    await page.keyboard.up(key);
    return place();
  };
  return { page, errors, place, hold };
}

test('the eye comes to its height above the floor, and walls stop the body', async (t) => {
  const { page, errors, hold, place } = await openRoom(t);
  const [x, y, z] = await hold('KeyW', () => view.camera.position.z < -2.6);
  assert.ok(Math.abs(x) < NEAR && Math.abs(y - (EYE_HEIGHT - HALF)) < NEAR, `${[x, y, z]}`);
  await page.keyboard.down('KeyW');
  await page.waitForTimeout(500);
  await page.keyboard.up('KeyW');
  const [, , after] = await place();
  assert.ok(after > -HALF + GIRTH - NEAR, `the wall was passed: ${after}`);
  assert.deepEqual(errors, []);
});

test('a wall that is met at a slant is walked along', async (t) => {
  const { page, hold } = await openRoom(t);
  await page.keyboard.down('KeyD');
  const [x, , z] = await hold('KeyW', () => view.camera.position.z < -2.6 && view.camera.position.x > 2.6);
  await page.keyboard.up('KeyD');
  assert.ok(x < HALF - GIRTH + NEAR && z > -HALF + GIRTH - NEAR, `${[x, z]}`);
});

test('left and right turn, and a drag turns the head', async (t) => {
  const { page, hold, place } = await openRoom(t);
  const before = await place();
  await hold('ArrowLeft', () => view.view.theta > 0.3);
  await page.mouse.move(100, 100);
  await page.mouse.down();
  await page.mouse.move(100, 60, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => view.view.phi > 1.7 || view.view.phi < 1.45);
  const after = await place();
  for (const axis of [0, 2]) assert.ok(Math.abs(after[axis] - before[axis]) < 1e-6, `${before} became ${after}`);
});

test('a thumb on the stick walks', async (t) => {
  const size = { width: 320, height: 180 };
  const { page, errors } = await openRoom(t, { ...size, hasTouch: true, isMobile: true });
  const box = await page.evaluate(() => {
    const { left, top, width } = view.shadowRoot.querySelector('b').getBoundingClientRect();
    return { left, top, width };
  });
  const at = (x, y) => [(box.left + x * box.width) / size.width, (box.top + y * box.width) / size.height];
  const fingers = await openFingers(page, size);
  await fingers.put(at(0.5, 0.5));
  await fingers.drag(at(0.5, 0));
  await page.waitForFunction(() => view.camera.position.z < -0.5);
  await fingers.lift();
  assert.deepEqual(errors, []);
});

test('when the attribute says so the visitor circles again', async (t) => {
  const { page, place } = await openRoom(t);
  await page.evaluate(() => view.setAttribute('camera-controls', ''));
  const { theta } = await page.evaluate(() => view.view);
  const before = await place();
  await page.keyboard.press('KeyW');
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction((angle) => view.view.theta !== angle, theta);
  assert.notDeepEqual(await place(), before);
  assert.equal(await page.evaluate(() => canvas.style.touchAction), 'pan-y');
});

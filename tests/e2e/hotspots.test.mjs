// SPDX-License-Identifier: Apache-2.0
//
// Children of the element that stand at points of its scene.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ABOVE, bakeBall, FAR, NEAR, openBall as open, SIZE } from './ball.mjs';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { temporaryFolder } from './packs.mjs';

const HOTSPOTS = `
  <button slot="hotspot-front" data-position="0m 0.6m 0.8m" data-normal="0 0.6 0.8" data-orbit="90deg 60deg 3m" data-target="0m 0.5m 0m">F</button>
  <button slot="hotspot-back" data-position="0 0 -1">B</button>
  <button slot="hotspot-left" data-position="-1 0 0" data-normal="-1 0 0" data-camera="From above">L</button>`;
/** A browser may round the place of a layer to pixels. */
const PIXEL = 0.5;

const PACK = bakeBall(temporaryFolder());
const browser = await forAllTests(launch());
const openBall = (t, options) => open(t, browser, PACK, { children: HOTSPOTS, ...options });

const hotspot = (page, name) => page.locator(`[slot=hotspot-${name}]`);

/** Waits until a hotspot is in a state: 'away', 'behind', or none. */
const state = (page, name, wanted) =>
  page.waitForFunction(
    ([slot, expected]) => (document.querySelector(`[slot=hotspot-${slot}]`).dataset.hidden ?? 'none') === expected,
    [name, wanted],
  );

async function assertOver(page, name, [x, y]) {
  const box = await hotspot(page, name).boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  assert.ok(Math.abs(middle[0] - x) < PIXEL && Math.abs(middle[1] - y) < PIXEL, `${middle} is not ${[x, y]}`);
}

/** Where a camera on the z axis that looks along -z sees a point. */
function seen([x, y, z]) {
  const scale = SIZE.height / 2 / Math.tan(Math.PI / 8) / (FAR - z);
  return [SIZE.width / 2 + scale * x, SIZE.height / 2 - scale * y];
}

test('each stands over its point, and follows the camera', async (t) => {
  const { page, errors } = await openBall(t);
  await hotspot(page, 'front').waitFor();
  await assertOver(page, 'front', seen([0, 0.6, 0.8]));
  await assertOver(page, 'left', seen([-1, 0, 0]));
  // From the left side the camera looks along x: what was at the left is in front.
  await page.evaluate(() => {
    view.view = { ...view.view, theta: -Math.PI / 2 };
    view.draw();
  });
  await assertOver(page, 'left', [SIZE.width / 2, SIZE.height / 2]);
  assert.deepEqual(errors, []);
});

test('it is marked that one faces away, or is behind the model', async (t) => {
  const { page } = await openBall(t);
  await state(page, 'front', 'none');
  await state(page, 'left', 'away');
  await state(page, 'back', 'behind');
  assert.equal(await hotspot(page, 'back').evaluate((element) => getComputedStyle(element).opacity), '0.25');
  await page.evaluate(() => (view.view = { ...view.view, theta: Math.PI }));
  await state(page, 'back', 'none');
  await state(page, 'front', 'away');
});

test('a click brings the camera to the hotspot’s view', async (t) => {
  const { page, view, errors } = await openBall(t);
  await hotspot(page, 'front').click();
  await page.waitForFunction(() => Math.abs(view.view.radius - 3) < 1e-6);
  const { theta, phi, target } = await view();
  assert.ok(Math.abs(theta - Math.PI / 2) < 1e-6 && Math.abs(phi - Math.PI / 3) < 1e-6, `${[theta, phi]}`);
  target.forEach((value, axis) => assert.ok(Math.abs(value - [0, 0.5, 0][axis]) < 1e-6));
  assert.deepEqual(errors, []);
});

test('the camera goes to hotspots and to cameras of the file by their names, and to a view', async (t) => {
  const { page, view, start } = await openBall(t);
  await page.evaluate(() => view.goTo('front'));
  assert.ok(Math.abs((await view()).radius - 3) < 1e-6);
  for (const name of ['From above', 'left']) {
    await page.evaluate((view) => globalThis.view.goTo(view), start);
    assert.ok(Math.abs((await view()).radius - FAR) < 1e-6);
    await page.evaluate((name) => view.goTo(name), name);
    const position = await page.evaluate(() => view.camera.position.toArray());
    position.forEach((value, axis) => assert.ok(Math.abs(value - ABOVE[axis]) < NEAR, `${name}: ${position}`));
  }
  assert.match(await page.evaluate(() => view.goTo('nowhere').catch(String)), /no camera “nowhere”/);
});

test('one that comes later, or moves, is placed, too', async (t) => {
  const { page } = await openBall(t, { children: '' });
  await page.evaluate(() => {
    globalThis.late = Object.assign(document.createElement('button'), { slot: 'hotspot-late', textContent: 'N' });
    late.dataset.position = '0 1 0';
    view.append(late);
  });
  await hotspot(page, 'late').waitFor();
  await assertOver(page, 'late', seen([0, 1, 0]));
  await page.evaluate(() => (late.dataset.position = '0 -1 0'));
  await assertOver(page, 'late', seen([0, -1, 0]));
});

test('children of other slots stay where they are', async (t) => {
  const { page } = await openBall(t, { children: '<p slot="error">No.</p>' });
  assert.equal(await page.evaluate(() => view.shadowRoot.querySelectorAll('slot').length), 2);
});

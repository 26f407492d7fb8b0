// SPDX-License-Identifier: Apache-2.0
//
// A double click or double tap: the camera glides to what was hit.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { at, bakeBall, meets, NEAR, openBall as open } from './ball.mjs';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { temporaryFolder } from './packs.mjs';

/** In pixels from the middle: where the ball is hit, and where it is missed. */
const [HIT, MISS] = [40, 150];

const PACK = bakeBall(temporaryFolder());
const browser = await forAllTests(launch());
const openBall = (t, options) => open(t, browser, PACK, options);

/** Resolves when the element says that its camera rests where it looks at the point that was hit, from half as far. */
async function assertFocused(page, view) {
  const { point, distance } = meets(HIT);
  await page.waitForFunction((far) => Math.abs(globalThis.view.view.radius - far) < 0.03, distance / 2);
  const now = await view();
  now.target.forEach((value, axis) => assert.ok(Math.abs(value - point[axis]) < NEAR, `${now.target} is not ${point}`));
  assert.ok(Math.abs(now.theta) < 1e-6 && Math.abs(now.phi - Math.PI / 2) < 1e-6, 'the camera has turned');
}

test('a double click glides to the point that was hit', async (t) => {
  const { page, errors, start, view } = await openBall(t);
  await page.evaluate(() => {
    globalThis.seen = new Set();
    const note = () => (globalThis.seen.add(globalThis.view.view.radius), requestAnimationFrame(note));
    note();
  });
  await page.mouse.dblclick(...at(HIT));
  await assertFocused(page, view);
  const between = await page.evaluate(() => [...globalThis.seen]);
  assert.ok(between.filter((radius) => radius < start.radius).length > 3, `no glide: ${between}`);
  assert.deepEqual(errors, []);
});

test('a double tap does, too', async (t) => {
  const { page, errors, view } = await openBall(t, { hasTouch: true, isMobile: true });
  for (let i = 0; i < 2; i++) await page.touchscreen.tap(...at(HIT));
  await assertFocused(page, view);
  assert.deepEqual(errors, []);
});

test('a double click beside the model returns', async (t) => {
  const { page, start, view } = await openBall(t);
  await page.evaluate(() => (globalThis.view.view = { ...globalThis.view.view, theta: 1 }));
  await page.mouse.dblclick(...at(MISS));
  await page.waitForFunction((theta) => Math.abs(globalThis.view.view.theta - theta) < 1e-6, start.theta);
  assert.deepEqual((await view()).target, start.target);
});

test('what the visitor does meanwhile ends the glide', async (t) => {
  const { page, start } = await openBall(t);
  const radius = await page.evaluate(async ([x, y]) => {
    const canvas = view.shadowRoot.querySelector('canvas');
    const moved = () => new Promise((resolve) => requestAnimationFrame(() => resolve(view.view.radius)));
    canvas.dispatchEvent(new MouseEvent('dblclick', { clientX: x, clientY: y }));
    const from = view.view.radius;
    while ((await moved()) === from);
    canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'Shift', bubbles: true, composed: true }));
    const ended = await moved();
    return [ended, await new Promise((resolve) => setTimeout(() => resolve(view.view.radius), 1000))];
  }, at(HIT));
  assert.equal(radius[0], radius[1]);
  assert.ok(radius[0] > meets(HIT).distance / 2 + 0.05 && radius[0] < start.radius, `${radius}`);
});

test('without camera-controls nothing happens', async (t) => {
  const { page, start, view } = await openBall(t, { attributes: '' });
  await page.mouse.dblclick(...at(HIT));
  await page.waitForTimeout(500);
  assert.deepEqual(await view(), start);
});

test('a visitor who wants no motion is there at once', async (t) => {
  const { page, view, start } = await openBall(t, { reducedMotion: 'reduce' });
  const views = await page.evaluate(async ([x, y]) => {
    view.shadowRoot.querySelector('canvas').dispatchEvent(new MouseEvent('dblclick', { clientX: x, clientY: y }));
    const seen = new Set();
    const ended = performance.now() + 2000;
    while (performance.now() < ended) await new Promise((resolve) => requestAnimationFrame(() => resolve(seen.add(view.view.radius))));
    return [...seen];
  }, at(HIT));
  await assertFocused(page, view);
  const { radius } = await view();
  assert.deepEqual(views.filter((seen) => seen !== start.radius && seen !== radius), [], 'places between');
});

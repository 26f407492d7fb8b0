// SPDX-License-Identifier: Apache-2.0
//
// How the camera glides and comes to rest, with few frames a second as with many.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** A key turns by so much, in radians. */
const TURN = Math.PI / 36;
/** Three frames a second. */
const SLOW = 333;
/** A tenth of a glide is left after 0.8 s; two slow frames, and as much again for a busy machine. Milliseconds. */
const LONGEST_GLIDE = 3000;
/** Rounding of sines and cosines. */
const SAME = 1e-6;

/** Runs in the page before its scripts: the browser has time for a frame every SLOW milliseconds. */
const FEW_FRAMES = `globalThis.requestAnimationFrame = (call) => setTimeout(() => call(performance.now()), ${SLOW});
globalThis.cancelAnimationFrame = clearTimeout;`;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 2_000);
const browser = await forAllTests(launch());
const server = await forAllTests(startStaticServer({ ...viewerPage('/pack.lw.glb'), '/pack.lw.glb': PACK }));

async function openView(t, { init = undefined, reducedMotion = undefined } = {}) {
  const { page, errors } = await forTest(t, openPage(browser, { init }));
  if (reducedMotion !== undefined) await page.emulateMedia({ reducedMotion });
  await page.goto(server.url);
  await complete(page);
  await page.evaluate(() => {
    globalThis.view = document.querySelector('lightwell-view');
    globalThis.canvas = view.shadowRoot.querySelector('canvas');
    canvas.focus();
  });
  return { page, errors, theta: () => page.evaluate(() => view.view.theta) };
}

/** Resolves when the element says that its camera rests. */
const rest = (page) => page.evaluate(() => new Promise((resolve) => view.addEventListener('camera-change', resolve, { once: true })));

/** Milliseconds from a key until a tenth of its turn is left. */
const timeOfGlide = (page, start) =>
  page.evaluate(
    ([from, turn]) =>
      new Promise((resolve) => {
        const began = performance.now();
        canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }));
        const look = () => (Math.abs(view.view.theta - from) >= 0.9 * turn ? resolve(performance.now() - began) : setTimeout(look, 5));
        look();
      }),
    [start, TURN],
  );

test('a key’s glide takes no longer with three frames a second', async (t) => {
  const { page, errors, theta } = await openView(t, { init: FEW_FRAMES });
  const time = await timeOfGlide(page, await theta());
  assert.ok(time < LONGEST_GLIDE, `${time} ms`);
  assert.deepEqual(errors, []);
});

test('a key turns by as much with few frames as with many', async (t) => {
  for (const init of [FEW_FRAMES, undefined]) {
    const { page, theta } = await openView(t, { init });
    const start = await theta();
    const rested = rest(page);
    await page.keyboard.press('ArrowRight');
    await rested;
    // The controls end a glide where a frame moves the camera by less than a millimetre: the shorter the frames, the sooner; with 60 a second it has a
    // twentieth of the turn left.
    assert.ok(Math.abs(Math.abs((await theta()) - start) - TURN) < TURN / 10, `from ${start} to ${await theta()}`);
  }
});

test('Home ends a glide where the pack’s view is', async (t) => {
  const { page, errors } = await openView(t);
  const views = await page.evaluate(async () => {
    const press = (key) => canvas.dispatchEvent(new KeyboardEvent('keydown', { key }));
    const start = view.view;
    for (let i = 0; i < 5; i++) press('ArrowLeft');
    await new Promise((resolve) => requestAnimationFrame(resolve));
    press('Home');
    const after = [];
    for (let frame = 0; frame < 20; frame++) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      after.push(view.view);
    }
    return [start, ...after];
  });
  for (const { theta, phi, radius } of views)
    for (const [value, first] of [[theta, views[0].theta], [phi, views[0].phi], [radius, views[0].radius]])
      assert.ok(Math.abs(value - first) < SAME, `${value} is not ${first}`);
  assert.deepEqual(errors, []);
});

test('a visitor who wants no motion sees none: a key turns at once', async (t) => {
  const { page, theta } = await openView(t, { reducedMotion: 'reduce' });
  const start = await theta();
  const seen = await page.evaluate(async () => {
    canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }));
    const seen = new Set();
    for (let frame = 0; frame < 20; frame++) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      seen.add(view.view.theta);
    }
    return [...seen];
  });
  const moved = seen.filter((angle) => Math.abs(angle - start) > SAME);
  for (const angle of moved) assert.ok(Math.abs(Math.abs(angle - start) - TURN) < SAME, `${seen}`);
  assert.ok(moved.length > 0);
});

test('where frames are slow the picture has fewer pixels while the camera moves, and all of them at rest', async (t) => {
  const { page, errors } = await openView(t, { init: FEW_FRAMES });
  const full = await page.evaluate(() => canvas.width);
  const before = await page.evaluate(() => view.toDataURL());
  for (let i = 0; i < 6; i++) await page.keyboard.press('ArrowRight');
  await page.waitForFunction((width) => canvas.width < width, full);
  await page.waitForFunction((width) => canvas.width === width, full);
  await page.keyboard.press('Home');
  await page.waitForFunction((picture) => view.toDataURL() === picture, before);
  assert.deepEqual(errors, []);
});

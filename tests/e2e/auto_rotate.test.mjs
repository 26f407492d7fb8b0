// SPDX-License-Identifier: Apache-2.0
//
// The attribute auto-rotate: the camera turns while nobody does anything.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { at, bakeBall, openBall as open } from './ball.mjs';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { temporaryFolder } from './packs.mjs';

/** Longer than the rest before a turn begins, in milliseconds. */
const LONG = 4500;
/** Much shorter than that. */
const SHORT = 1000;
/** The angle is found from the camera's place: rounding, in radians. */
const STILL = 1e-9;

const PACK = bakeBall(temporaryFolder());
const browser = await forAllTests(launch());
/** Shadows that grow softer would ask for frames, too. */
const openBall = (t, options) => open(t, browser, PACK, { attributes: 'camera-controls auto-rotate shadows="hard"', ...options });

const turns = (page, from) => page.waitForFunction((theta) => view.view.theta > theta + 0.01, from);

/** How far it turns in some milliseconds, and how many frames are drawn meanwhile. */
const motion = (page, milliseconds) =>
  page.evaluate(async (time) => {
    let frames = 0;
    const count = () => frames++;
    view.addEventListener('frame', count);
    const { theta } = view.view;
    await new Promise((resolve) => setTimeout(resolve, time));
    view.removeEventListener('frame', count);
    return { turned: view.view.theta - theta, frames };
  }, milliseconds);

test('it turns after a rest, stops on input, and turns again', async (t) => {
  const { page, start, errors } = await openBall(t);
  await turns(page, start.theta);
  await page.mouse.move(...at(0));
  await page.mouse.down();
  const held = await motion(page, LONG);
  assert.ok(Math.abs(held.turned) < STILL, 'it turns under the visitor’s hand');
  await page.mouse.up();
  const { theta, radius } = await page.evaluate(() => view.view);
  assert.ok(Math.abs((await motion(page, SHORT)).turned) < STILL);
  await turns(page, theta);
  assert.ok(Math.abs((await page.evaluate(() => view.view.radius)) - radius) < 1e-6);
  assert.deepEqual(errors, []);
});

test('it ends when the attribute goes', async (t) => {
  const { page, start } = await openBall(t);
  await turns(page, start.theta);
  await page.evaluate(() => view.removeAttribute('auto-rotate'));
  await page.waitForFunction(() => view.frameRate === 0);
  assert.deepEqual(await motion(page, LONG), { turned: 0, frames: 0 });
});

test('a visitor who wants no motion sees none', async (t) => {
  const { page } = await openBall(t, { reducedMotion: 'reduce' });
  assert.ok(Math.abs((await motion(page, LONG)).turned) < STILL);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  await turns(page, (await page.evaluate(() => view.view)).theta);
});

test('out of sight it costs no frame', async (t) => {
  const { page, start } = await openBall(t, { after: '<p style="height: 3000px">' });
  await turns(page, start.theta);
  await page.evaluate(() => {
    globalThis.asked = 0;
    const { requestAnimationFrame } = globalThis;
    globalThis.requestAnimationFrame = (call) => (asked++, requestAnimationFrame(call));
    scrollTo(0, 2000);
  });
  await page.waitForFunction(() => scrollY > 1000);
  await page.waitForTimeout(SHORT);
  await page.evaluate(() => (globalThis.asked = 0));
  assert.ok(Math.abs((await motion(page, LONG)).turned) < STILL);
  assert.equal(await page.evaluate(() => asked), 0);
  await page.evaluate(() => scrollTo(0, 0));
  await turns(page, (await page.evaluate(() => view.view)).theta);
});

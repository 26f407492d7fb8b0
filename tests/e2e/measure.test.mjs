// SPDX-License-Identifier: Apache-2.0
//
// The attribute measure: two clicks and the metres between their points.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { at, bakeBall, meets, NEAR, openBall as open } from './ball.mjs';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { temporaryFolder } from './packs.mjs';

const PACK = bakeBall(temporaryFolder());
const browser = await forAllTests(launch());

/** With the attribute set, when its script is there. */
async function openBall(t) {
  const opened = await open(t, browser, PACK);
  await opened.page.evaluate(() => {
    globalThis.measured = [];
    view.addEventListener('measure', ({ detail }) => measured.push(detail));
    view.setAttribute('measure', '');
  });
  await opened.page.locator('lightwell-view svg').waitFor({ state: 'attached' });
  return opened;
}

const length = (a, b) => Math.hypot(...a.map((value, axis) => value - b[axis]));
const label = (page) => page.locator('lightwell-view output');

test('two clicks show a line between their points and its length', async (t) => {
  const { page, view, start, errors } = await openBall(t);
  await page.mouse.click(...at(-40));
  assert.equal(await label(page).isVisible(), false);
  await page.mouse.click(...at(40));
  await label(page).waitFor();
  const [{ metres, from, to }] = await page.evaluate(() => measured);
  const truth = length(meets(-40).point, meets(40).point);
  assert.ok(Math.abs(metres - truth) < 2 * NEAR, `${metres} m, not ${truth}`);
  assert.ok(Math.abs(length(from, to) - metres) < 1e-6);
  assert.equal(await label(page).textContent(), `${Number(metres.toPrecision(3))} m`);
  const ends = await page.locator('lightwell-view line').first().evaluate((line) => ['x1', 'y1', 'x2', 'y2'].map((name) => Number(line.getAttribute(name))));
  [...at(-40), ...at(40)].forEach((value, i) => assert.ok(Math.abs(ends[i] - value) < 1, `${ends}`));
  assert.deepEqual(await view(), start, 'the camera has moved');
  assert.deepEqual(errors, []);
});

test('a drag and a click beside the model measure nothing', async (t) => {
  const { page } = await openBall(t);
  await page.mouse.click(...at(150));
  await page.mouse.move(...at(0));
  await page.mouse.down();
  await page.mouse.move(...at(30), { steps: 3 });
  await page.mouse.up();
  const seen = await page.locator('lightwell-view circle').evaluateAll((ends) => ends.map((end) => end.getAttribute('visibility')));
  assert.deepEqual(seen, ['hidden', 'hidden']);
});

test('the line follows the camera, and escape ends all of it', async (t) => {
  const { page, errors } = await openBall(t);
  for (const pixels of [-40, 40]) await page.mouse.click(...at(pixels));
  await label(page).waitFor();
  const place = () => page.locator('lightwell-view line').first().getAttribute('x1');
  const before = await place();
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((x) => view.shadowRoot.querySelector('line').getAttribute('x1') !== x, before);
  await page.keyboard.press('Escape');
  await label(page).waitFor({ state: 'detached' });
  assert.equal(await page.evaluate(() => view.hasAttribute('measure')), false);
  await page.mouse.click(...at(0));
  assert.equal(await page.evaluate(() => view.shadowRoot.querySelector('svg')), null);
  assert.deepEqual(errors, []);
});

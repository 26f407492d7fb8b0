// SPDX-License-Identifier: Apache-2.0
//
// When the shadows of lamps are good enough: what is shown is compared with what it becomes, as a visitor sees it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch } from './browser.mjs';
import { irradianceBehindEdge, LAMP_BEHIND_EDGE } from './lamp_parts.mjs';
import { forAllTests } from './lifetime.mjs';
import { stepsBetween } from './screen_steps.mjs';
import { openScript } from './test_page.mjs';

const browser = await forAllTests(launch());
const open = async (t) => {
  const opened = await openScript(t, browser, 'tests/e2e/pages/settling.ts');
  await opened.page.waitForFunction(() => globalThis.shownOf);
  return opened;
};

/** The irradiance of the floor at a pixel of a row of so many. */
const irradianceAt = (i, pixels) => irradianceBehindEdge(-0.48 + (0.96 * (i + 0.5)) / pixels);

test('what the page says of how far off a penumbra is bounds how far off it is', async (t) => {
  const { page, errors } = await open(t);
  const { shown, moved } = await page.evaluate((lamp) => shownOf(lamp, true), LAMP_BEHIND_EDGE);
  for (const { row, samples, error } of shown) {
    const off = Math.max(...row.map((value, i) => stepsBetween(value, irradianceAt(i, row.length))));
    t.diagnostic(`${samples} samples: said ${error.toFixed(2)}, is ${off.toFixed(2)}`);
    // What is said is taken at some of the pixels: at others it may be a little more.
    assert.ok(off <= Math.max(1, 1.2 * error), `${samples} samples are off by ${off}, said ${error}`);
  }
  assert.deepEqual(moved, [Infinity, 0], 'roundings of the camera are no motion');
  assert.ok(shown.length >= 5, `a penumbra is refined: ${shown.length} pictures`);
  assert.deepEqual(errors, []);
});

test('a lamp with nothing in its way is at rest at once, and so it is dimmed; where it gets much brighter its shadow is looked at again', async (t) => {
  const { page, errors } = await open(t);
  const { shown, brighter } = await page.evaluate((lamp) => shownOf(lamp, false), LAMP_BEHIND_EDGE);
  assert.deepEqual(shown.map(({ error }) => error), [0]);
  assert.deepEqual(brighter, [Infinity, Infinity, 16]);
  assert.deepEqual(errors, []);
});

/** Contrast masks a step where it is twice a smooth surface's step, by a power of it (Legge, Foley, Contrast Masking in Human Vision, 1980). */
const POWER = 0.62;

test('the largest step that is not seen is one of the screen, more where contrast masks it, and at most six', async (t) => {
  const { page, errors } = await open(t);
  const contrasts = [0, 1, 2, 4, 8, 16, 32, 36, 60].map((contrast) => contrast / 255);
  const found = await page.evaluate((of) => permittedDifferences(of), contrasts);
  found.forEach((step, i) => {
    const expected = Math.min(6, Math.max(1, (255 * contrasts[i] / 2) ** POWER)) / 255;
    assert.ok(Math.abs(step - expected) < 0.002 * expected, `${255 * contrasts[i]} of contrast: ${255 * step}`);
  });
  assert.deepEqual(errors, []);
});

test('those farthest off get the next samples, evenly, as many as they have; young ones before all others', async (t) => {
  const { page, errors } = await open(t);
  const roundOf = (lamps) => page.evaluate((of) => roundOf(of), lamps);
  const times = (count, ...numbers) => Array.from({ length: count }, () => numbers).flat();
  assert.deepEqual(await roundOf([[16, 1.5], [16, 4], [16, 3]]), times(16, 1, 2));
  assert.deepEqual(await roundOf([[16, 4], [14, Infinity]]), [1, 1]);
  assert.deepEqual(await roundOf([[16, 4], [48, 4]]), [...times(16, 0), ...times(16, 1)]);
  assert.deepEqual(errors, []);
});

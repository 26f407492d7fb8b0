// SPDX-License-Identifier: Apache-2.0
//
// What a camera keeps of shadows that it has seen, when it moves: penumbras are compared with their closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch } from './browser.mjs';
import { irradianceBehindEdge, LAMP_BEHIND_EDGE } from './lamp_parts.mjs';
import { forAllTests } from './lifetime.mjs';
import { stepsBetween } from './screen_steps.mjs';
import { openScript } from './test_page.mjs';

const browser = await forAllTests(launch());
const open = async (t) => {
  const opened = await openScript(t, browser, 'tests/e2e/pages/moving.ts');
  await opened.page.waitForFunction(() => globalThis.movesOn);
  return opened;
};

/** Of a row of the floor around a place, `half` to both sides: the irradiance of its pixels. */
const expectedOf = (row, place, half) => row.map((_, i) => irradianceBehindEdge(place - half + (2 * half * (i + 0.5)) / row.length));

/** Root of the mean square. */
function errorOf(row, expected) {
  return Math.sqrt(row.reduce((sum, value, i) => sum + (value - expected[i]) ** 2, 0) / row.length);
}

test('a camera that moves keeps the penumbra it has seen, and at rest needs nothing of it', async (t) => {
  const { page, errors } = await open(t);
  const places = [0.02, 0.04, 0.06];
  const { first, without, rest, alone, textures } = await page.evaluate(([lamp, to]) => movesOn(lamp, to, 0.4), [LAMP_BEHIND_EDGE, places]);
  const expected = expectedOf(first, places.at(-1), 0.4);
  const of = (row) => errorOf(row, expected);
  const steps = Math.max(...rest.map((value, i) => stepsBetween(value, expected[i])));
  t.diagnostic(`first ${of(first)}, without ${of(without)}, at rest ${of(rest)} (${steps} steps), who has seen nothing, at rest: ${of(alone)}`);
  assert.ok(of(first) <= 1.2 * of(alone), `${of(first)} is more than 1.2 times ${of(alone)}`);
  assert.ok(of(without) > 4 * of(first), `who has seen nothing has ${of(without)}`);
  // The page says 1 at most, taken at some of the pixels: at others it may be a little more.
  assert.ok(steps <= 1.2, `at rest off by ${steps}`);
  assert.equal(textures[1], textures[0], 'at rest nothing of it takes memory');
  assert.deepEqual(errors, []);
});

for (const [what, name] of [['lamp', 'a lamp that has moved'], ['object', 'an object that has come'], ['shadows', 'other shadows that are asked for']])
  test(`${name}: nothing of the view before is shown`, async (t) => {
    const { page, errors } = await open(t);
    const [row, fresh] = await page.evaluate(([lamp, of]) => changes(lamp, of), [LAMP_BEHIND_EDGE, what]);
    assert.deepEqual(row, fresh);
    assert.deepEqual(errors, []);
  });

test('a camera that moves keeps the sky as a lamp: nothing is seen to change', async (t) => {
  const { page, errors } = await open(t);
  const [rested, ...later] = await page.evaluate(() => underSky());
  // Those of few directions count little beside what is known: what was shown is 512.
  const steps = later.map((row) => Math.max(...row.map((value, i) => stepsBetween(value / 4, rested[i] / 4))));
  t.diagnostic(`${later.length} pictures, off by ${steps.map((of) => of.toFixed(2))} steps`);
  assert.ok(later.length > 4 && Math.max(...steps) < 3, `off by ${steps}`);
  assert.deepEqual(errors, []);
});

test('of two cameras that take turns each shows the shadows that were seen', async (t) => {
  const { page, errors } = await open(t);
  const [rested, last] = await page.evaluate((lamp) => takesTurns(lamp, 10), LAMP_BEHIND_EDGE);
  const [before, after] = [rested, last].map((row) => errorOf(row, expectedOf(row, 0, 0.48)));
  t.diagnostic(`before ${before}, after ${after}`);
  assert.ok(after <= 1.2 * before, `${after} is more than 1.2 times ${before}`);
  assert.deepEqual(errors, []);
});

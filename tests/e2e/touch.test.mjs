// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { openFingers } from './fingers.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startServe } from './servers.mjs';
import { complete } from './view.mjs';

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 1_000);
/** Rounding of sines and cosines, relative. */
const SAME = 1e-6;

const browser = await forAllTests(launch());
const server = await forAllTests(startServe(PACK));

/** A phone's page, and what moves fingers on it: each goes from one place to another, as parts of the screen. */
async function openPhone(t) {
  const size = { width: 195, height: 422 };
  const { page, errors } = await forTest(t, openPage(browser, { ...size, hasTouch: true }));
  await page.goto(server.url);
  await complete(page);
  const { move } = await openFingers(page, size);
  const view = () => page.evaluate(() => document.querySelector('lightwell-view').view);
  return { move, view, errors };
}

const near = (a, b) => Math.abs(a - b) <= SAME * Math.max(1, Math.abs(a));
const sameTarget = (a, b) => a.target.every((value, axis) => near(value, b.target[axis]));

test('a finger turns the scene', async (t) => {
  const { move, view, errors } = await openPhone(t);
  const before = await view();
  await move({ from: [0.3, 0.3], to: [0.6, 0.3] });
  const now = await view();
  assert.ok(now.theta < before.theta, 'to the right: the camera goes left around it');
  assert.ok(near(now.radius, before.radius) && sameTarget(now, before));
  assert.deepEqual(errors, []);
});

test('two fingers that part come nearer', async (t) => {
  const { move, view, errors } = await openPhone(t);
  const before = await view();
  await move({ from: [0.45, 0.3], to: [0.2, 0.3] }, { from: [0.55, 0.3], to: [0.8, 0.3] });
  const now = await view();
  assert.ok(now.radius < 0.9 * before.radius, `${before.radius} became ${now.radius}`);
  assert.deepEqual(errors, []);
});

test('two fingers side by side move the scene', async (t) => {
  const { move, view, errors } = await openPhone(t);
  const before = await view();
  await move({ from: [0.3, 0.3], to: [0.5, 0.4] }, { from: [0.5, 0.3], to: [0.7, 0.4] });
  const now = await view();
  assert.ok(!sameTarget(now, before));
  assert.ok(Math.abs(now.radius / before.radius - 1) < 0.05, `${before.radius} became ${now.radius}`);
  assert.deepEqual(errors, []);
});

// SPDX-License-Identifier: Apache-2.0
//
// The page of `lightwell serve --watch` follows the scene.
import assert from 'node:assert/strict';
import { renameSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { startServe } from './servers.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { complete, loaded, pauseAfter, paused } from './view.mjs';

const browser = await forAllTests(launch());

/** Bytes a second: all of the file would come before the page can be told to wait. */
const SLOW = 100_000;

const VIEW = { theta: 0.5, phi: 1.25, radius: 2.5, target: [0.1, 0.2, 0.3] };

/** A room of so many balls, written as programs write: beside its place first. */
function writeRoom(file, balls) {
  const white = { pbrMetallicRoughness: { baseColorFactor: [0.8, 0.8, 0.8, 1], metallicFactor: 0 } };
  const shapes = [{ mesh: room(2), material: white }];
  for (let i = 0; i < balls; i++) shapes.push({ mesh: sphere(0.3, 6), material: white, at: [i - 1, 0, 0] });
  writeScene(`${file}.new`, shapes, [{ lamp: { type: 'point', intensity: 10 }, at: [0, 1.5, 0] }]);
  renameSync(`${file}.new`, file);
}

const shows = (page, meshes) =>
  page.waitForFunction((count) => {
    const view = document.querySelector('lightwell-view');
    let found = 0;
    view.pack?.traverse(({ isMesh }) => (found += isMesh ? 1 : 0));
    return view.complete && found === count;
  }, meshes);

const view = (page) => page.evaluate(() => document.querySelector('lightwell-view').view);

async function watch(t) {
  const file = `${temporaryFolder()}/room.gltf`;
  writeRoom(file, 1);
  const server = await forTest(t, startServe(['--watch', file, '--bake', '--grid 4 --quiet', '--quiet']));
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url);
  return { ...opened, file, server };
}

test('a scene that changes is shown, and the camera stays', async (t) => {
  const { page, errors, file } = await watch(t);
  await shows(page, 2);
  await page.evaluate((wanted) => (document.querySelector('lightwell-view').view = wanted), VIEW);
  const before = await view(page);
  writeRoom(file, 3);
  await shows(page, 4);
  assert.deepEqual(await view(page), before);
  writeFileSync(file, 'nothing');
  await new Promise((resolve) => setTimeout(resolve, 3000));
  await shows(page, 4);
  writeRoom(file, 2);
  await shows(page, 3);
  assert.deepEqual(await view(page), before);
  assert.deepEqual(errors, []);
});

test('a page does not ask for packs again where they do not change', async (t) => {
  const pack = writeSamplePack(`${temporaryFolder()}/a.lw.glb`, 2_000);
  const server = await forTest(t, startServe(pack));
  const { page } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await complete(page);
  const requests = [];
  page.on('request', (request) => requests.push(request.url()));
  await new Promise((resolve) => setTimeout(resolve, 2500));
  assert.deepEqual(requests, []);
});

test('a file that is replaced while it streams is shown in the same view', async (t) => {
  const folder = temporaryFolder();
  writeSamplePack(`${folder}/a.lw.glb`, 200_000);
  const server = await forTest(t, startServe(`${folder}/a.lw.glb`));
  const relay = await forTest(t, startSlowRelay(server.url, SLOW));
  const { page } = await forTest(t, openPage(browser, { init: pauseAfter(100_000) }));
  await page.goto(relay.url);
  await loaded(page);
  await paused(page);
  await page.evaluate((wanted) => (document.querySelector('lightwell-view').view = wanted), VIEW);
  const before = await view(page);
  writeSamplePack(`${folder}/b.lw.glb`, 100_000);
  renameSync(`${folder}/b.lw.glb`, `${folder}/a.lw.glb`);
  await page.evaluate(() => {
    const element = document.querySelector('lightwell-view');
    element.addEventListener('error', ({ detail }) => (globalThis.replaced = detail.reason === 'replaced'));
    element.resume();
  });
  await page.waitForFunction(() => globalThis.replaced);
  await complete(page);
  assert.deepEqual(await view(page), before);
});

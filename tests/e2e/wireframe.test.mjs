// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, LLVMPIPE, openPage, SWIFTSHADER } from './browser.mjs';
import { RECORD_GL } from './gl_recorder.mjs';
import { forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startServe } from './servers.mjs';
import { complete } from './view.mjs';

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 5_000);

/** Shows edges, surfaces and edges again: the three pictures, and what each made the GPU allocate. */
async function toggle(t, renderer) {
  const browser = await forTest(t, launch(renderer));
  const server = await forTest(t, startServe(PACK));
  const { page, errors } = await openPage(browser, { init: RECORD_GL });
  await page.goto(server.url);
  await complete(page);
  const surfaces = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
  const steps = await page.evaluate(async () => {
    const view = document.querySelector('lightwell-view');
    const steps = [];
    for (const wireframe of [true, false, true]) {
      globalThis.glRecord.reset();
      view.toggleAttribute('wireframe', wireframe);
      await view.pack.setWireframe(wireframe);
      steps.push({ picture: view.toDataURL(), allocations: globalThis.glRecord.allocations });
    }
    return steps;
  });
  assert.deepEqual(errors, []);
  assert.notEqual(steps[0].picture, surfaces);
  assert.equal(steps[1].picture, surfaces);
  assert.equal(steps[2].picture, steps[0].picture);
  return steps.map(({ allocations }) => allocations.length);
}

test('edges cost no memory where the GPU draws them', async (t) => {
  assert.deepEqual(await toggle(t, SWIFTSHADER), [0, 0, 0]);
});

test('elsewhere a buffer a mesh, the first time', async (t) => {
  const [first, ...others] = await toggle(t, LLVMPIPE);
  assert.ok(first > 0);
  assert.deepEqual(others, [0, 0]);
});

// SPDX-License-Identifier: Apache-2.0
//
// A surface in several materials is refined as one: no crack opens between them while it comes, and each keeps its own material.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { openScript } from './test_page.mjs';

const folder = temporaryFolder();
const MATERIALS = 5;

/** A bumpy hollow ball in patches of five materials, a primitive each of one mesh. */
function writeBall(file) {
  const ball = sphere(2, 120);
  for (let i = 0; i < ball.positions.length; i += 3) {
    const [x, y, z] = ball.positions.slice(i, i + 3);
    const bump = 1 + 0.04 * Math.sin(9 * x) * Math.sin(8 * y) * Math.sin(7 * z);
    for (const [axis, value] of [x, y, z].entries()) ball.positions[i + axis] = value * bump;
  }
  const material = { pbrMetallicRoughness: { metallicFactor: 0 }, doubleSided: true };
  const patch = (corner) => {
    const [x, y, z] = ball.positions.slice(3 * corner, 3 * corner + 3);
    return Math.floor(3 * x + 2 * Math.sin(3 * y) + z + 100) % MATERIALS;
  };
  const triangles = Array.from({ length: ball.indices.length / 3 }, (_, i) => ball.indices.slice(3 * i, 3 * i + 3));
  const shapes = Array.from({ length: MATERIALS }, (_, i) => ({
    mesh: { ...ball, indices: triangles.filter(([corner]) => patch(corner) === i).flat() },
    material: { ...material, name: `material ${i}` },
  }));
  writeScene(file, shapes, [{ lamp: { type: 'point', intensity: 50 }, at: [0, 0, 0] }]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.meshes = [{ primitives: gltf.meshes.flatMap(({ primitives }) => primitives) }];
  gltf.nodes = [{ mesh: 0 }, gltf.nodes.at(-1)];
  gltf.scenes[0].nodes = [0, 1];
  writeFileSync(file, JSON.stringify(gltf));
  return { file, faces: shapes.map(({ mesh }) => mesh.indices.length / 3) };
}

const browser = await forAllTests(launch());

test('no crack opens between materials at any level', async (t) => {
  const { file, faces } = writeBall(`${folder}/ball.gltf`);
  const pack = bake(file, `${folder}/ball.lw.glb`, { photons: 20_000, grid: 4 });
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/regions.ts', { '/pack.lw.glb': pack });
  await page.waitForFunction(() => globalThis.completed);
  await page.evaluate(() => completed);
  const states = await page.evaluate(() => states);
  assert.equal(await page.evaluate(() => streams), 1);
  assert.ok(states.length > 3, `${states.length} states`);
  assert.deepEqual(states.at(-1).faces, faces);
  const total = (state) => state.faces.reduce((sum, count) => sum + count);
  assert.ok(total(states[0]) < total(states.at(-1)) / 20, 'the first is coarse');
  for (const state of states) {
    assert.equal(state.faces.length, MATERIALS);
    assert.equal(state.background, 0, `with ${state.faces} faces`);
  }
  assert.deepEqual(errors, []);
});

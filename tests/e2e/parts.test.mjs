// SPDX-License-Identifier: Apache-2.0
//
// Scenes of very many parts: few meshes on the page, which tell their parts by name; taken apart by the programs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch } from './browser.mjs';

import { forAllTests } from './lifetime.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { openScript } from './test_page.mjs';

const folder = temporaryFolder();
const SIDE = 6;
const RADIUS = 0.3;

/** Balls of three materials in rows on a plane, each with a name and extras. */
function writeBalls(file) {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const places = Array.from({ length: SIDE * SIDE }, (_, i) => [i % SIDE, 0, Math.floor(i / SIDE)]);
  const balls = places.map((at) => ({ mesh: sphere(RADIUS, 12), material, at }));
  const scene = writeScene(file, [{ mesh: room(8), material }, ...balls], [{ lamp: { type: 'point', intensity: 5 }, at: [2.5, 4, 2.5] }]);
  const gltf = JSON.parse(readFileSync(scene, 'utf8'));
  gltf.materials.length = 3;
  gltf.nodes.forEach((node, i) => {
    if (node.mesh === undefined || i === 0) return;
    node.name = `ball ${i}`;
    node.extras = { number: i };
    gltf.meshes[node.mesh].name = `mesh ${i}`;
    gltf.meshes[node.mesh].primitives[0].material = i % 3;
  });
  writeFileSync(scene, JSON.stringify(gltf));
  return scene;
}

const browser = await forAllTests(launch());
const source = writeBalls(`${folder}/balls.gltf`);
const pack = bake(source, `${folder}/balls.lw.glb`);

test('many parts are few meshes, of which each hit tells its part', async (t) => {
  const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/parts.ts', { '/pack.lw.glb': pack });
  await page.waitForFunction(() => globalThis.completed);
  await page.evaluate(() => completed);
  assert.ok((await page.evaluate(() => meshes)) <= 4, 'a mesh for each material, and the room');
  // What tells of them comes behind all that is seen.
  await page.waitForFunction(() => partBelow(0, 1, 0));
  for (const [x, z] of [[0, 0], [3, 2], [5, 5]]) {
    const number = 1 + z * SIDE + x;
    const { node, mesh, bounds } = await page.evaluate(([x, z]) => partBelow(x + 0.1, 1, z), [x, z]);
    assert.deepEqual([node.name, node.extras, mesh.name], [`ball ${number}`, { number }, `mesh ${number}`]);
    const [min, max] = bounds;
    // A lattice of 14 bits on the largest part, and a sphere's polygon.
    [x - RADIUS, -RADIUS, z - RADIUS].forEach((least, i) => assert.ok(Math.abs(min[i] - least) < 0.01, `${min}`));
    [x + RADIUS, RADIUS, z + RADIUS].forEach((most, i) => assert.ok(Math.abs(max[i] - most) < 0.01, `${max}`));
  }
  assert.deepEqual(errors, []);
});

test('what is taken apart again has the names, places and faces of its file', () => {
  const original = JSON.parse(readFileSync(source, 'utf8'));
  for (const command of [['export', pack], ['fetch', pack]]) {
    const output = `${folder}/${command[0]}.glb`;
    execFileSync(`${BIN}/lightwell`, [...command, '-o', output]);
    const file = readFileSync(output);
    const gltf = JSON.parse(file.subarray(20, 20 + file.readUInt32LE(12)).toString());
    for (const node of original.nodes.filter(({ name }) => name?.startsWith('ball'))) {
      const found = gltf.nodes.find(({ name }) => name === node.name);
      assert.deepEqual([found.extras, found.translation], [node.extras, node.translation], `${command[0]}: ${node.name}`);
      const faces = ({ accessors, meshes }, { mesh }) => accessors[meshes[mesh].primitives[0].indices].count;
      assert.equal(faces(gltf, found), faces(original, node));
    }
  }
});

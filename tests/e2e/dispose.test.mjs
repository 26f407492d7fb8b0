// SPDX-License-Identifier: Apache-2.0
//
// A pack that is disposed of leaves nothing on the GPU, whatever is in it.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { ROOT } from './dependencies.mjs';
import { COUNT_OBJECTS } from './gl_recorder.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { CLIENT, scriptPage } from './test_page.mjs';

const folder = temporaryFolder();
const GREY = { pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicFactor: 0 }, normalTexture: { index: 0 } };
const [ROOM, BALL, BLOB, SKINNED, MANY] = [0, 1, 2, 3, 4];

/**
 * A room that comes whole and a ball that a stream refines, with pictures of both kinds; a ball that changes its form, one with a
 * skeleton, and several that are one mesh.
 */
function writeEverything(file) {
  const balls = [80, 12, 12, 12].map((steps, i) => ({ mesh: sphere(0.2, steps), material: { ...GREY }, at: [i / 2, 0, 0] }));
  const lamps = ['point', 'spot'].map((type) => ({ lamp: { type, intensity: 1 }, at: [0, 0.5, 0.9] }));
  const scene = writeScene(file, [{ mesh: room(1.5), material: GREY }, ...balls], lamps);
  const gltf = JSON.parse(readFileSync(scene, 'utf8'));
  gltf.images.push({ uri: `data:image/jpeg;base64,${readFileSync(`${ROOT}docs/results/box.jpg`, 'base64')}` });
  gltf.textures.push({ source: 1 });
  gltf.materials[BALL].emissiveTexture = { index: 1 };
  const primitive = (mesh) => gltf.meshes[mesh].primitives[0];
  const positions = primitive(BLOB).attributes.POSITION;
  primitive(BLOB).targets = [{ POSITION: positions }];
  const { count } = gltf.accessors[positions];
  const zeros = (componentType) => gltf.accessors.push({ componentType, count, type: 'VEC4' }) - 1;
  Object.assign(primitive(SKINNED).attributes, { JOINTS_0: zeros(5123), WEIGHTS_0: zeros(5126) });
  gltf.skins = [{ joints: [ROOM] }];
  gltf.nodes[SKINNED].skin = 0;
  const corners = primitive(ROOM).attributes.POSITION;
  gltf.nodes[MANY].extensions = { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: corners } } };
  gltf.extensionsUsed.push('EXT_mesh_gpu_instancing');
  writeFileSync(scene, JSON.stringify(gltf));
  return scene;
}

const browser = await forAllTests(launch());

test('after dispose the GPU holds what it held before, of meshes and textures with and without streams', async (t) => {
  const pack = bake(writeEverything(`${folder}/all.gltf`), `${folder}/all.lw.glb`);
  const script = await scriptPage('tests/e2e/pages/dispose.ts');
  const server = await forTest(t, startStaticServer({ ...script, ...CLIENT, '/pack.lw.glb': pack }));
  const { page, errors } = await forTest(t, openPage(browser, { init: COUNT_OBJECTS }));
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.showOnce);
  // What the renderer makes for itself, such as the table of the materials' reflection, comes with the first pack and stays.
  const [first, ...later] = await page.evaluate(async () => {
    const rounds = [];
    for (let i = 0; i < 4; i++) rounds.push({ ...(await showOnce()), objects: { ...objects } });
    return rounds;
  });
  // Of meshes the ball, the one that changes its form and the one with a skeleton; of textures the one of them all.
  assert.deepEqual(first.streams, [3, 1]);
  assert.ok(first.shown.geometries >= 5, `only ${first.shown.geometries} of the meshes were drawn`);
  assert.deepEqual([first.gone.geometries, first.objects.Buffer, first.objects.VertexArray], [0, 0, 0]);
  for (const round of later) assert.deepEqual(round, first);
  assert.deepEqual(errors, []);
});

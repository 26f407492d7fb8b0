// SPDX-License-Identifier: Apache-2.0
//
// A pack is a glTF file: programs that know nothing of Lightwell open it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { NodeIO, validateBytes } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { BIN, temporaryFolder } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { scriptPage } from './test_page.mjs';

const folder = temporaryFolder();
const pack = `${folder}/box.lw.glb`;
execFileSync(`${BIN}/lightwell`, ['bake', 'box-small', '-o', pack, '--photons', '100000', '--grid', '8', '--quiet']);

const browser = await forAllTests(launch());

test('gltf-validator finds no error', async () => {
  const { issues } = await validateBytes(new Uint8Array(readFileSync(pack)));
  assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.filter(({ severity }) => severity === 0)));
});

test('glTF-Transform reads the coarse scene', async () => {
  const document = await new NodeIO().readBinary(new Uint8Array(readFileSync(pack)));
  const primitives = document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives());
  assert.ok(primitives.length > 0);
  for (const primitive of primitives) assert.ok(primitive.getAttribute('POSITION').getCount() > 2);
});

test('the GLTFLoader of three.js shows the coarse scene', async (t) => {
  const server = await forTest(t, startStaticServer({ ...(await scriptPage('tests/e2e/pages/plain_gltf.ts')), '/pack.glb': pack }));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.triangles !== undefined);
  assert.ok((await page.evaluate(() => globalThis.triangles)) > 10);
  assert.deepEqual(errors, []);
});

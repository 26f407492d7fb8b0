// SPDX-License-Identifier: Apache-2.0
//
// The tarball in a Next.js project, whose pages are made where there is no document. It takes minutes: for `./run test --all`.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from '../browser.mjs';
import { forTest } from '../lifetime.mjs';
import { temporaryFolder, writeSamplePack } from '../packs.mjs';
import { makeProject, makeTarball, run } from '../projects.mjs';
import { startStaticServer } from '../static_server.mjs';
import { complete } from '../view.mjs';

const FILES = {
  'next.config.mjs': "export default { output: 'export' };\n",
  'app/layout.jsx': 'export default ({ children }) => <html lang="en"><body>{children}</body></html>;\n',
  'app/page.jsx': `'use client';
import 'lightwell/element';

export default () => <lightwell-view src="/packs/room.lw.glb" camera-controls="" style={{ height: '80vh' }} />;
`,
};

test('Next.js', async (t) => {
  const packs = temporaryFolder();
  writeSamplePack(`${packs}/room.lw.glb`, 2_000);
  const project = makeProject(makeTarball(), ['three@0.187', 'next@16', 'react@19', 'react-dom@19'], FILES);
  process.env.NEXT_TELEMETRY_DISABLED = '1';
  run(project, 'npx', 'next', 'build');
  const server = await forTest(t, startStaticServer({ '/': `${project}/out`, '/packs/': packs }));
  const browser = await forTest(t, launch());
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await complete(page);
  assert.equal(page.workers().length, 1);
  assert.deepEqual(errors, []);
});

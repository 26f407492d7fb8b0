// SPDX-License-Identifier: Apache-2.0
//
// The tarball in projects of other people: installed, built as their tool is used, opened, and no file copied by hand.
import assert from 'node:assert/strict';
import { lstatSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { spawn } from 'node:child_process';
import { launch, openPage } from './browser.mjs';
import { WEB } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { document, makeProject, makeTarball, run, write } from './projects.mjs';
import { startStaticServer } from './static_server.mjs';
import { complete } from './view.mjs';

const packs = temporaryFolder();
writeSamplePack(`${packs}/room.lw.glb`, 2_000);
const THREE = ['three@0.187', '@types/three@0.187'];
const TOOLS = ['vite@8', 'webpack@5', 'webpack-cli', 'esbuild', 'typescript@7', '@types/react@19'];
const SCRIPT = "import 'lightwell/element';\n";

const tarball = makeTarball();
const project = makeProject(tarball, [...THREE, ...TOOLS], { 'main.js': SCRIPT });
const browser = await forAllTests(launch());

/** Opens what a server has at a path and waits until the pack is complete; a worker decodes, and the console is empty. */
async function assertShown(t, url) {
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(url);
  await complete(page);
  assert.equal(page.workers().length, 1, 'the page decodes by itself');
  assert.deepEqual(errors, []);
}

async function assertBuilt(t, folder, path = '') {
  const server = await forTest(t, startStaticServer({ '/': folder, '/packs/': packs }));
  await assertShown(t, server.url + path);
}

test('plain HTML: the page of web/README.md', async (t) => {
  const readme = readFileSync(`${WEB}README.md`, 'utf8');
  const page = /```html\n([^]*?)```/.exec(readme)[1].replace('src="room.lw.glb"', 'src="/packs/room.lw.glb"');
  write(project, { 'plain.html': `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">${page}` });
  await assertBuilt(t, project, 'plain.html');
});

test('Vite, built', async (t) => {
  write(project, { 'index.html': document('<script type="module" src="/main.js"></script>') });
  run(project, 'npx', 'vite', 'build', '--outDir', 'by-vite', '--logLevel', 'error');
  await assertBuilt(t, `${project}/by-vite`);
});

test('another package that is installed later leaves it where it is', async (t) => {
  run(project, 'npm', 'install', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel=error', 'tslib');
  assert.ok(lstatSync(`${project}/node_modules/lightwell`).isDirectory(), 'a link leads out of the project, where Vite serves nothing');
  run(project, 'npx', 'vite', 'build', '--outDir', 'by-vite-again', '--logLevel', 'error');
  await assertBuilt(t, `${project}/by-vite-again`);
});

test('Vite, while it is worked on', async (t) => {
  write(project, { 'index.html': document('<script type="module" src="/main.js"></script>'), 'public/packs/room.lw.glb': readFileSync(`${packs}/room.lw.glb`) });
  const vite = spawn('node', ['node_modules/vite/bin/vite.js', '--port', '0', '--host', '127.0.0.1'], { cwd: project, env: { ...process.env, NO_COLOR: '1' } });
  t.after(() => vite.kill());
  const url = await new Promise((resolve, reject) => {
    let text = '';
    vite.stdout.on('data', (data) => {
      const match = /http:\/\/\S+/.exec((text += data));
      if (match !== null) resolve(match[0]);
    });
    vite.once('exit', () => reject(new Error(text)));
  });
  await assertShown(t, url);
});

test('webpack', async (t) => {
  const said = run(project, 'npx', 'webpack', '--mode', 'production', '--entry', './main.js', '--output-path', 'by-webpack');
  assert.doesNotMatch(said, /Critical dependency/);
  write(project, { 'by-webpack/index.html': document('<script defer src="main.js"></script>') });
  await assertBuilt(t, `${project}/by-webpack`);
});

test('esbuild', async (t) => {
  const parts = ['worker.js', 'lightwell.wasm'].map((name) => `node_modules/lightwell/dist/${name}`);
  const flags = ['--bundle', '--format=esm', '--loader:.wasm=copy', '--entry-names=[name]', '--outdir=by-esbuild', '--log-level=warning'];
  run(project, 'npx', 'esbuild', 'main.js', ...parts, ...flags);
  write(project, { 'by-esbuild/index.html': document('<script type="module" src="main.js"></script>') });
  await assertBuilt(t, `${project}/by-esbuild`);
});

test('importing where there is no document does nothing', () => {
  for (const name of ['lightwell', 'lightwell/three', 'lightwell/element'])
    assert.equal(run(project, 'node', '--eval', `import('${name}').then((all) => console.log(Object.keys(all).length > 0))`).trim(), 'true');
});

test('TypeScript knows the element, its events and its attributes', () => {
  write(project, {
    'tsconfig.json': JSON.stringify({
      compilerOptions: { strict: true, noEmit: true, target: 'ES2022', module: 'ESNext', moduleResolution: 'bundler', jsx: 'react-jsx' },
      files: ['consumer.tsx'],
    }),
    'consumer.tsx': readFileSync(new URL('./pages/consumer.tsx', import.meta.url)),
  });
  run(project, 'npx', 'tsc', '--project', '.');
});

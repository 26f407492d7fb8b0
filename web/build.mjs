// SPDX-License-Identifier: Apache-2.0
//
// Builds dist/: the package (core.js, three.js, element.js, with three.js left to its user), the worker, the page and, when
// its path is given, lightwell.wasm:   node build.mjs [WASM]
import { spawnSync } from 'node:child_process';
import { copyFile, mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { bundle, FOR_BUNDLERS } from './bundle.mjs';

/** Properties that three.js keeps to itself: the page holds all of three.js, so that nothing else needs their names. */
const PRIVATE_PROPERTIES = /^_[a-z]/;

/** What three.js uses where it is there and the page needs not: a browser's extension for developers, videos, layers of a headset. */
const ABSENT = Object.fromEntries(
  ['__THREE_DEVTOOLS__', 'HTMLVideoElement', 'VideoFrame', 'XRWebGLBinding'].map((name) => [name, 'undefined']),
);

process.chdir(import.meta.dirname);
await rm('dist', { recursive: true, force: true });
await mkdir('dist');
const bundles = await Promise.all([
  bundle(
    {
      entryPoints: { core: 'src/core/index.ts', three: 'src/three/index.ts', element: 'src/element/index.ts' },
      external: ['three', 'three/*'],
      splitting: true,
    },
    FOR_BUNDLERS,
  ),
  bundle({ entryPoints: { worker: 'src/core/worker.ts' } }),
  bundle({
    entryPoints: { page: 'src/page/main.ts', style: 'src/page/style.css' },
    splitting: true,
    chunkNames: 'page-[name]',
    loader: { '.html': 'text' },
    mangleProps: PRIVATE_PROPERTIES,
    define: ABSENT,
  }),
]);
await Promise.all(bundles.flat().map(({ path, text }) => writeFile(path, text)));
await writeFile('dist/index.html', (await readFile('src/page/index.html', 'utf8')).replace(/^ +/gm, ''));
const wasm = process.argv[2];
if (wasm !== undefined) await copyFile(wasm, 'dist/lightwell.wasm');

await copyFile('../LICENSE', 'dist/LICENSE');
await mkdir('dist/types');
await copyFile('src/react.d.ts', 'dist/types/react.d.ts');
const types = ['--project', '.', '--noEmit', 'false', '--emitDeclarationOnly', '--declaration', '--outDir', 'dist/types'];
const { status } = spawnSync('node_modules/.bin/tsc', types, { stdio: 'inherit' });
process.exit(status ?? 1);

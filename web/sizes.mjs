// SPDX-License-Identifier: Apache-2.0
//
// Prints how large the page is in brotli, in bytes: all of it, and the part that is Lightwell's (three.js and its loader and
// controls left out).   node sizes.mjs [--json]
import { readFile } from 'node:fs/promises';
import { brotliCompressSync } from 'node:zlib';
import { bundle } from './bundle.mjs';

process.chdir(import.meta.dirname);
const compressed = async (file) => brotliCompressSync(await readFile(file)).length;
const [own] = await bundle({ entryPoints: ['src/page/main.ts'], external: ['three', 'three/*'] });
const [worker, wasm, page, html, style] = await Promise.all(
  ['worker.js', 'lightwell.wasm', 'page.js', 'index.html', 'style.css'].map((name) => compressed(`dist/${name}`)),
);
const script = brotliCompressSync(own.text).length;
const sizes = { script, worker, wasm, withoutThree: script + worker + wasm, whole: page + worker + wasm + html + style };
if (process.argv.includes('--json')) console.log(JSON.stringify(sizes));
else for (const [name, bytes] of Object.entries(sizes)) console.log(`${name.padEnd(14)}${bytes}`);

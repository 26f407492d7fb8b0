// SPDX-License-Identifier: Apache-2.0
//
// Prints how large the page is in brotli, in bytes: all that is loaded before the first picture, the part of it that is Lightwell's
// (three.js and its loader and controls left out), and what is fetched later, when it is asked for.   node sizes.mjs [--json]
import { readdir, readFile } from 'node:fs/promises';
import { basename } from 'node:path';
import { brotliCompressSync } from 'node:zlib';
import { bundle } from './bundle.mjs';

process.chdir(import.meta.dirname);
const sizeOf = (text) => brotliCompressSync(text).length;
const compressed = async (...files) => {
  const texts = await Promise.all(files.map((file) => readFile(`dist/${file}`)));
  return texts.reduce((sum, text) => sum + sizeOf(text), 0);
};
const bundled = await bundle({
  entryPoints: ['src/page/main.ts'],
  external: ['three', 'three/*'],
  splitting: true,
  chunkNames: 'page-[name]',
  loader: { '.html': 'text' },
});
const own = bundled.find(({ path }) => basename(path) === 'main.js');
const script = sizeOf(own.text);
const worker = await compressed('worker.js');
const wasm = await compressed('lightwell.wasm');
const whole = worker + wasm + (await compressed('page.js', 'index.html', 'style.css'));
const later = await compressed(...(await readdir('dist')).filter((name) => /^page-.*\.js$/.test(name)));
const sizes = { script, worker, wasm, withoutThree: script + worker + wasm, whole, later };
if (process.argv.includes('--json')) console.log(JSON.stringify(sizes));
else for (const [name, bytes] of Object.entries(sizes)) console.log(`${name.padEnd(14)}${bytes}`);

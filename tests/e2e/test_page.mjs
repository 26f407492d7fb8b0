// SPDX-License-Identifier: Apache-2.0
import { glslPlugin } from '../../web/glsl_plugin.mjs';
import { build, ROOT, WEB } from './dependencies.mjs';

/** Bundles a script of tests/e2e/pages/ or web/examples/, with three.js; gives its text. */
export async function bundle(path) {
  const result = await build({
    entryPoints: [`${ROOT}${path}`],
    bundle: true,
    format: 'esm',
    target: 'es2022',
    write: false,
    nodePaths: [`${WEB}node_modules`],
    plugins: [glslPlugin],
  });
  return result.outputFiles[0].text;
}

/** Routes of a page at / that runs a bundled script. */
export async function scriptPage(path) {
  const html = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="module" src="script.js"></script>`;
  return {
    '/': { text: html, type: 'text/html' },
    '/script.js': { text: await bundle(path), type: 'text/javascript' },
  };
}

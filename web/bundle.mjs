// SPDX-License-Identifier: Apache-2.0
import { build } from 'esbuild';
import { minify } from 'terser';
import { glslPlugin } from './glsl_plugin.mjs';

/**
 * Bundles by esbuild's options and shortens by terser, whose names compress 4 % better than esbuild's own. Gives each file's
 * path in dist/ and its text.
 */
export async function bundle(options) {
  const { outputFiles } = await build({
    absWorkingDir: import.meta.dirname,
    bundle: true,
    format: 'esm',
    target: 'es2022',
    minify: true,
    outdir: 'dist',
    legalComments: 'none',
    logLevel: 'warning',
    plugins: [glslPlugin],
    write: false,
    ...options,
  });
  return Promise.all(outputFiles.map(async ({ path, text }) => ({ path, text: path.endsWith('.js') ? await shorten(text) : text })));
}

/**
 * No getter of three.js or ours has side effects. Functions with arguments are not inlined and comparisons not turned round: they
 * compress better as they are.
 */
async function shorten(script) {
  const compress = { passes: 3, pure_getters: true, inline: 1, lhs_constants: false };
  const { code } = await minify(script, { module: true, ecma: 2020, compress });
  return code;
}

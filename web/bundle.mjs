// SPDX-License-Identifier: Apache-2.0
import { build } from 'esbuild';
import { minify } from 'terser';
import { textPlugins } from './text_plugins.mjs';

/** What a script says to the bundlers of those who use it. */
export const FOR_BUNDLERS = /webpackIgnore|@vite-ignore/;

/**
 * Bundles by esbuild's options and shortens by terser, whose names compress 4 % better than esbuild's own. Keeps the comments of
 * a pattern. Gives each file's path in dist/ and its text.
 */
export async function bundle(options, comments = false) {
  const { outputFiles } = await build({
    absWorkingDir: import.meta.dirname,
    bundle: true,
    format: 'esm',
    target: 'es2022',
    minifySyntax: true,
    minifyIdentifiers: true,
    minifyWhitespace: comments === false,
    outdir: 'dist',
    legalComments: 'none',
    logLevel: 'warning',
    plugins: textPlugins,
    write: false,
    ...options,
  });
  return Promise.all(outputFiles.map(async ({ path, text }) => ({ path, text: path.endsWith('.js') ? await shorten(text, comments) : text })));
}

/**
 * No getter of three.js or ours has side effects. Functions with arguments are not inlined and comparisons not turned round: they
 * compress better as they are.
 */
async function shorten(script, comments) {
  const compress = { passes: 3, pure_getters: true, inline: 1, lhs_constants: false };
  const { code } = await minify(script, { module: true, ecma: 2020, compress, format: { comments } });
  return code;
}

// SPDX-License-Identifier: Apache-2.0
import { readFile } from 'node:fs/promises';
import { transform } from 'esbuild';

/** A line without spaces where GLSL needs none; those of the preprocessor stay as they are. */
const tighten = (line) => (line.startsWith('#') ? line : line.replace(/ *([-+*/=<>!&|?:;,(){}[\]]) */g, '$1'));

/** For esbuild: shader text without comments, indentation, empty lines and needless spaces; statements stand in one line. */
const glsl = {
  name: 'glsl',
  setup(builder) {
    builder.onLoad({ filter: /\.glsl$/ }, async ({ path }) => {
      const lines = (await readFile(path, 'utf8')).split('\n').map((line) => tighten(line.replace(/\/\/.*$/, '').trim()));
      return { contents: `\n${lines.filter(Boolean).join('\n').replace(/([;{}])\n(?!#)/g, '$1')}\n`, loader: 'text' };
    });
  },
};

/** For esbuild: the element's style sheet, shortened. */
const css = {
  name: 'css',
  setup(builder) {
    builder.onLoad({ filter: /[/\\]element[/\\][^/\\]*\.css$/ }, async ({ path }) => {
      const { code } = await transform(await readFile(path, 'utf8'), { loader: 'css', minify: true });
      return { contents: code.trim(), loader: 'text' };
    });
  },
};

/** What scripts import as text. */
export const textPlugins = [glsl, css];

// SPDX-License-Identifier: Apache-2.0
import { readFile } from 'node:fs/promises';

/** A line without spaces where GLSL needs none; those of the preprocessor stay as they are. */
const tighten = (line) => (line.startsWith('#') ? line : line.replace(/ *([-+*/=<>!&|?:;,(){}[\]]) */g, '$1'));

/** For esbuild: shader text without comments, indentation, empty lines and needless spaces; statements stand in one line. */
export const glslPlugin = {
  name: 'glsl',
  setup(builder) {
    builder.onLoad({ filter: /\.glsl$/ }, async ({ path }) => {
      const lines = (await readFile(path, 'utf8')).split('\n').map((line) => tighten(line.replace(/\/\/.*$/, '').trim()));
      return { contents: `\n${lines.filter(Boolean).join('\n').replace(/([;{}])\n(?!#)/g, '$1')}\n`, loader: 'text' };
    });
  },
};

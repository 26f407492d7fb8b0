// SPDX-License-Identifier: Apache-2.0
import { readFile } from 'node:fs/promises';

/** For esbuild: shader text without comments, indentation and empty lines. */
export const glslPlugin = {
  name: 'glsl',
  setup(builder) {
    builder.onLoad({ filter: /\.glsl$/ }, async ({ path }) => {
      const lines = (await readFile(path, 'utf8')).split('\n').map((line) => line.replace(/\/\/.*$/, '').trim());
      return { contents: `\n${lines.filter(Boolean).join('\n')}\n`, loader: 'text' };
    });
  },
};

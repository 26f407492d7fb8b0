// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { WEB } from './dependencies.mjs';

/**
 * Bytes in brotli. Nothing may grow beyond these (docs/decisions/008-size-of-the-page.md): what is loaded before the first picture,
 * without three.js and with it, and the scripts that are fetched when they are asked for.
 */
const LIMITS = { withoutThree: 73_728, whole: 199_400, later: 33_000 };

test('the page stays small', () => {
  const sizes = JSON.parse(execFileSync('node', [`${WEB}sizes.mjs`, '--json'], { encoding: 'utf8' }));
  for (const [name, limit] of Object.entries(LIMITS))
    assert.ok(sizes[name] <= limit, `${name}: ${sizes[name]} bytes (counted on WebAssembly built where wasm-opt of binaryen is installed)`);
});

test('the page’s script imports no other at its start: what is fetched later shares nothing with it', () => {
  assert.doesNotMatch(readFileSync(`${WEB}dist/page.js`, 'utf8'), /(^|;)import\s*[{"*]/);
});

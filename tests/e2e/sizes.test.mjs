// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { WEB } from './dependencies.mjs';

/**
 * Bytes in brotli. Nothing may grow beyond these (docs/decisions/008-size-of-the-page.md).
 */
const LIMITS = { withoutThree: 62_000, whole: 187_000 };

test('the page stays small', () => {
  const sizes = JSON.parse(execFileSync('node', [`${WEB}sizes.mjs`, '--json'], { encoding: 'utf8' }));
  for (const [name, limit] of Object.entries(LIMITS)) 
    assert.ok(sizes[name] <= limit, `${name}: ${sizes[name]} bytes (counted on WebAssembly built where wasm-opt of binaryen is installed)`);
});

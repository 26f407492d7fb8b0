// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { WEB } from './dependencies.mjs';

/**
 * Bytes in brotli. Nothing may grow beyond these, what was reached without wasm-opt; 60,000 and 180,000 are aimed at
 * (docs/decisions/008-size-of-the-page.md).
 */
const LIMITS = { withoutThree: 65_500, whole: 199_000 };

test('the page stays small', () => {
  const sizes = JSON.parse(execFileSync('node', [`${WEB}sizes.mjs`, '--json'], { encoding: 'utf8' }));
  for (const [name, limit] of Object.entries(LIMITS)) assert.ok(sizes[name] <= limit, `${name}: ${sizes[name]} bytes`);
});

// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';
import { ROOT } from './dependencies.mjs';

/** Where the programs are that CMake built. */
export const BIN = process.env.LIGHTWELL_BIN ?? `${ROOT}build/release/bin`;

/** A folder that is gone after the tests. */
export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), 'lightwell-e2e-'));
  after(() => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/** Writes a pack of about so many triangles whose light is a formula. */
export function writeSamplePack(file, triangles) {
  execFileSync(`${BIN}/sample_pack`, [file, String(triangles)]);
  return file;
}

/** Bakes a scene with few photons and a coarse grid; `options` are those of the command, true for a flag. */
export function bake(scene, file, options = {}) {
  const flags = Object.entries({ photons: 100_000, grid: 8, ...options }).flatMap(([name, value]) => (value === true ? [`--${name}`] : [`--${name}`, String(value)]));
  execFileSync(`${BIN}/lightwell`, ['bake', scene, '-o', file, '--quiet', ...flags]);
  return file;
}

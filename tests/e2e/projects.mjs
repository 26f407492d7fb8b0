// SPDX-License-Identifier: Apache-2.0
//
// Projects of other people: an empty folder into which the npm package is installed from its tarball.
import { execFileSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { ROOT, WEB } from './dependencies.mjs';
import { temporaryFolder } from './packs.mjs';

/** Runs a program in a folder; its output is in the error when it fails. */
export const run = (folder, program, ...options) => execFileSync(program, options, { cwd: folder, encoding: 'utf8', stdio: 'pipe' });

/** Makes the tarball, as ./run build does; gives its path. */
export function makeTarball() {
  mkdirSync(`${ROOT}build`, { recursive: true });
  return resolve(ROOT, 'build', run(WEB, 'npm', 'run', '--silent', 'tarball').trim());
}

/** A new project with some packages besides, and files of its own: their texts by path. */
export function makeProject(tarball, packages, files) {
  const folder = temporaryFolder();
  write(folder, { 'package.json': JSON.stringify({ name: 'someone', private: true, type: 'module' }), ...files });
  run(folder, 'npm', 'install', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel=error', tarball, ...packages);
  return folder;
}

export function write(folder, files) {
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(dirname(`${folder}/${path}`), { recursive: true });
    writeFileSync(`${folder}/${path}`, text);
  }
}

/** A document with the element, and what its head holds. */
export const document = (head) => `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <link rel="icon" href="data:," />
    ${head}
  </head>
  <body>
    <lightwell-view src="/packs/room.lw.glb" camera-controls style="height: 80vh"></lightwell-view>
  </body>
</html>
`;

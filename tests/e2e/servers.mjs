// SPDX-License-Identifier: Apache-2.0
import { spawn } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { WEB } from './dependencies.mjs';
import { BIN } from './packs.mjs';

/** Starts `lightwell serve` for a pack, a folder, or a list of arguments; `port` 0 takes any. Resolves when it has said where it listens. */
export async function startServe(path, port = 0) {
  const child = spawn(`${BIN}/lightwell`, ['serve', ...[path].flat(), '--port', String(port), '--page', `${WEB}dist`], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  const line = await new Promise((resolve, reject) => {
    createInterface(child.stdout).once('line', resolve);
    child.once('exit', (code) => reject(new Error(`lightwell serve ended with ${code}`)));
  });
  const { url } = JSON.parse(line);
  return {
    url,
    close(signal = 'SIGTERM') {
      child.kill(signal);
      return ended;
    },
  };
}

/** Starts nginx for the files of a folder, as a static host of another origin; `scratch` takes its own files. */
export async function startNginx(folder, scratch) {
  const port = await freePort();
  mkdirSync(scratch, { recursive: true });
  const configuration = join(scratch, 'nginx.conf');
  writeFileSync(configuration, nginxConfiguration(folder, scratch, port));
  const child = spawn('nginx', ['-c', configuration, '-p', scratch, '-e', join(scratch, 'error.log')], { stdio: 'inherit' });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  const url = `http://127.0.0.1:${port}/`;
  await listening(url);
  return {
    url,
    close() {
      child.kill('SIGTERM');
      return ended;
    },
  };
}

function nginxConfiguration(folder, scratch, port) {
  const temporary = ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map((name) => `${name}_temp_path ${scratch}/${name};`);
  return `
    daemon off; worker_processes 1; pid ${scratch}/pid;
    ${process.getuid() === 0 ? 'user root;' : ''}
    events {}
    http {
      access_log off; ${temporary.join(' ')}
      server {
        listen 127.0.0.1:${port}; root ${folder};
        types { model/gltf-binary glb; }
        add_header Access-Control-Allow-Origin *;
        add_header Access-Control-Expose-Headers "Content-Range, ETag, Accept-Ranges";
      }
    }`;
}

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Waits until somebody answers, whatever. */
async function listening(url) {
  for (;;) {
    const answered = await fetch(url).then(
      () => true,
      () => false,
    );
    if (answered) return;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

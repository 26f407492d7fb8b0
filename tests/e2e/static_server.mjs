// SPDX-License-Identifier: Apache-2.0
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';

const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
  '.glb': 'model/gltf-binary',
  '.json': 'application/json',
};

/**
 * A plain web server for tests. `routes` maps a path, or the beginning of one that ends in a slash, to a file or folder, or to
 * the text of an answer. Options: `ranges` false answers 200 to every request; `wasmType` is the content type of WebAssembly;
 * `cors` says of a request whether pages of other origins may read the answer; `headers` go with each; `port` 0 takes any.
 */
export async function startStaticServer(
  routes,
  { ranges = true, wasmType = TYPES['.wasm'], cors = () => true, headers = {}, port = 0 } = {},
) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
    void answer(routes, { ranges, wasmType, cors }, path, request, response);
  });
  await new Promise((resolve) => server.listen(port, '127.0.0.1', resolve));
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    close: () => {
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}

async function answer(routes, { ranges, wasmType, cors }, path, request, response) {
  if (cors(request)) response.setHeader('Access-Control-Allow-Origin', '*');
  response.setHeader('Access-Control-Expose-Headers', 'Content-Range, ETag, Accept-Ranges');
  response.setHeader('Cache-Control', 'no-store');
  const target = resolveRoute(routes, path);
  if (target === null) return response.writeHead(404).end();
  if (target.text !== undefined) return response.writeHead(200, { 'Content-Type': target.type }).end(target.text);
  const file = await stat(target.file).catch(() => null);
  if (file === null || !file.isFile()) return response.writeHead(404).end();
  const type = extname(target.file) === '.wasm' ? wasmType : (TYPES[extname(target.file)] ?? 'application/octet-stream');
  const head = { 'Content-Type': type, ETag: `"${file.size}-${file.mtimeMs}"` };
  const range = ranges ? /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? '') : null;
  if (range === null) {
    response.writeHead(200, { ...head, 'Content-Length': file.size });
    return createReadStream(target.file).pipe(response);
  }
  const start = Number(range[1]);
  const end = Math.min(file.size - 1, range[2] === '' ? file.size - 1 : Number(range[2]));
  if (start > end) return response.writeHead(416, { 'Content-Range': `bytes */${file.size}` }).end();
  response.writeHead(206, { ...head, 'Content-Length': end - start + 1, 'Content-Range': `bytes ${start}-${end}/${file.size}` });
  createReadStream(target.file, { start, end }).pipe(response);
}

function resolveRoute(routes, path) {
  const exact = routes[path];
  if (exact?.text !== undefined) return exact;
  if (exact !== undefined && !path.endsWith('/')) return { file: exact };
  const prefixes = Object.keys(routes).filter((route) => route.endsWith('/') && path.startsWith(route));
  const prefix = prefixes.sort((a, b) => b.length - a.length)[0];
  if (prefix === undefined || path.includes('..')) return null;
  return { file: `${routes[prefix]}/${path.slice(prefix.length) || 'index.html'}` };
}

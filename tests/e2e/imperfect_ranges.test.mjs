// SPDX-License-Identifier: Apache-2.0
//
// Servers that answer requests for parts of a file in their own way: the page and `lightwell fetch` end with all of the pack, or with a
// line that says what is wrong, within 30 seconds.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { BIN, temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete, notice, progress } from './view.mjs';

const PATIENCE = 30_000;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/small.lw.glb`, 20_000);
const file = readFileSync(PACK);
const zipped = gzipSync(file);
const browser = await forAllTests(launch());

/** The header of a part, and its bytes. */
const part = (whole, first, last) => [`bytes ${first}-${last}/${whole.length}`, whole.subarray(first, last + 1)];

/** What a server says to a request for bytes: status, headers, body. */
const ANSWERS = {
  'parts shorter than asked for': (first, last) => {
    const [range, body] = part(file, first, Math.min(last, first + 2999));
    return [206, { 'Content-Range': range }, body];
  },
  'parts of what gzip makes of the file': (first, last) => {
    const [range, body] = part(zipped, first, Math.min(last, zipped.length - 1));
    return [206, { 'Content-Range': range, 'Content-Encoding': 'gzip' }, body];
  },
  'parts that are not named': (first, last) => [206, {}, part(file, first, last)[1]],
  'another part': (first, last) => {
    const [, body] = part(file, 0, last - first);
    return [206, { 'Content-Range': `bytes 0-${last - first}/${file.length}` }, body];
  },
  'several parts in one': (first, last) => {
    const [range, body] = part(file, first, last);
    const head = `--x\r\nContent-Type: model/gltf-binary\r\nContent-Range: ${range}\r\n\r\n`;
    return [206, { 'Content-Type': 'multipart/byteranges; boundary=x' }, Buffer.concat([Buffer.from(head), body, Buffer.from('\r\n--x--\r\n')])];
  },
};

/** A server of the pack alone, which any page may read. /moved/ leads to it. */
async function startServer(answerTo, whole = file) {
  const server = createServer((request, response) => {
    if (request.url.startsWith('/moved/')) return response.writeHead(302, { Location: request.url.slice('/moved'.length) }).end();
    if (request.url.startsWith('/round/')) return response.writeHead(302, { Location: request.url }).end();
    response.setHeader('Access-Control-Allow-Origin', '*');
    response.setHeader('Access-Control-Expose-Headers', 'Content-Range, ETag');
    response.setHeader('Access-Control-Allow-Headers', 'Range');
    const range = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? '');
    const [first, last] = range === null ? [] : [Number(range[1]), Math.min(Number(range[2]), file.length - 1)];
    if (range !== null && first >= file.length) return response.writeHead(416, { 'Content-Range': `bytes */${file.length}` }).end();
    const [status, headers, body] = range === null ? [200, {}, whole] : answerTo(first, last);
    response.writeHead(status, { 'Content-Length': body.length, ...headers });
    response.end(body);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return {
    url: `http://127.0.0.1:${server.address().port}/small.lw.glb`,
    close: () => (server.closeAllConnections(), new Promise((resolve) => server.close(resolve))),
  };
}

async function showPage(t, url) {
  const server = await forTest(t, startStaticServer(viewerPage(url)));
  const { page } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  return page;
}

function runFetch(url) {
  const child = spawn(`${BIN}/lightwell`, ['fetch', url, '--json', '--quiet'], { timeout: PATIENCE });
  let said = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text) => (said += text));
  return new Promise((resolve) => child.on('exit', (code) => resolve({ code, said })));
}

for (const [what, answer] of Object.entries(ANSWERS))
  test(`a server gives ${what}`, async (t) => {
    const { url } = await forTest(t, startServer(answer));
    const [page, fetched] = await Promise.all([showPage(t, url), runFetch(url)]);
    assert.equal(fetched.code, 0, fetched.said);
    await complete(page, PATIENCE);
    const { bytes, geometry, light } = await progress(page);
    assert.equal(bytes.done, statSync(PACK).size);
    for (const share of [geometry, light]) assert.equal(share.done, share.total);
  });

test('a server gives the beginning of the file for anything', async (t) => {
  const half = file.subarray(0, file.length / 2);
  const { url } = await forTest(t, startServer(() => [200, {}, half], half));
  const [page, fetched] = await Promise.all([showPage(t, url), runFetch(url)]);
  assert.equal(fetched.code, 1);
  const reason = `the file has ${half.length} bytes, but should have ${file.length}`;
  assert.match(fetched.said, new RegExp(reason));
  await notice(page, reason);
});

test('fetch follows a redirection, but not for ever', async (t) => {
  const { url } = await forTest(t, startServer((first, last) => [206, { 'Content-Range': part(file, first, last)[0] }, part(file, first, last)[1]]));
  const moved = await runFetch(url.replace('/small', '/moved/moved/small'));
  assert.equal(moved.code, 0, moved.said);
  const round = await runFetch(url.replace('/small', '/round/small'));
  assert.equal(round.code, 1);
  assert.match(round.said, /the server answers 302/);
});

// SPDX-License-Identifier: Apache-2.0
import { createServer, request as send } from 'node:http';
import { Transform } from 'node:stream';
import { setTimeout as sleep } from 'node:timers/promises';

const PIECE = 4096;

/** Lets bytes through at a rate, in bytes a second. */
function slow(rate) {
  return new Transform({
    async transform(chunk, _, done) {
      for (let at = 0; at < chunk.length; at += PIECE) {
        const piece = chunk.subarray(at, at + PIECE);
        await sleep((1000 * piece.length) / rate);
        this.push(piece);
      }
      done();
    },
  });
}

/**
 * Stands before a server and passes everything on, each body of a pack at `rate`: a fast line would bring all of it before a
 * busy page can say a word. Requests break while the server is away.
 */
export async function startSlowRelay(target, rate) {
  const relay = createServer((request, response) => {
    const onward = send(new URL(request.url, target), { headers: request.headers, agent: false }, (answer) => {
      response.writeHead(answer.statusCode, answer.headers);
      answer.on('error', () => response.destroy());
      if (request.url.endsWith('.glb')) answer.pipe(slow(rate)).pipe(response);
      else answer.pipe(response);
    });
    onward.on('error', () => response.destroy());
    onward.end();
  });
  await new Promise((resolve) => relay.listen(0, '127.0.0.1', resolve));
  return {
    url: `http://127.0.0.1:${relay.address().port}/`,
    close: () => {
      relay.closeAllConnections();
      return new Promise((resolve) => relay.close(resolve));
    },
  };
}

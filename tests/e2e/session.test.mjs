// SPDX-License-Identifier: Apache-2.0
//
// The worker's session without a browser: it drives the WebAssembly client over Node's own fetch.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { forAllTests } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { bundle, CLIENT } from './test_page.mjs';

const folder = temporaryFolder();
writeSamplePack(`${folder}/pack.lw.glb`, 2_000);
writeFileSync(`${folder}/session.mjs`, await bundle('web/src/core/session.ts'));
const { PackSession } = await import(`${folder}/session.mjs`);

/** Longer than a session leaves a client alone that has something to do; milliseconds. */
const REST = 300;

const server = await forAllTests(startStaticServer({ ...CLIENT, '/': folder }));

/** Starts a session: `events` collects what it says, `ended` resolves with its completion or failure. */
function startSession(t) {
  const events = [];
  let session;
  const ended = new Promise((resolve) => {
    session = new PackSession((batch) => {
      for (const event of batch) {
        events.push(event);
        if (event.type === 'failure' || (event.type === 'connection' && event.state === 'complete')) resolve(event);
      }
    });
  });
  t.after(() => session.close());
  session.command({ type: 'open', url: `${server.url}pack.lw.glb`, wasm: `${server.url}lightwell.wasm`, strategy: 'interleave' });
  return { session, events, ended };
}

/** From now on each call of one of the module's functions goes through `wrap(function, values)`. */
function wrapExport(t, name, wrap) {
  const { instantiate } = WebAssembly;
  t.mock.method(WebAssembly, 'instantiate', async (module, imports) => {
    const { exports } = await instantiate(module, imports);
    return { exports: { ...exports, [name]: (...values) => wrap(exports[name], values) } };
  });
}

test('a session brings a pack', async (t) => {
  const { ended } = startSession(t);
  assert.deepEqual(await ended, { type: 'connection', state: 'complete' });
});

for (const name of ['lw_next', 'lw_respond', 'lw_receive', 'lw_finish', 'lw_work', 'lw_take', 'lw_progress', 'lw_wake'])
  test(`a client that traps in ${name} ends the session in words, once, and is not called again`, async (t) => {
    let calls = 0;
    wrapExport(t, name, () => {
      calls++;
      throw new WebAssembly.RuntimeError('unreachable');
    });
    const { events, ended } = startSession(t);
    const failure = await ended;
    assert.equal(failure.type, 'failure');
    assert.match(failure.message, /unreachable/);
    await sleep(REST);
    assert.equal(calls, 1);
    assert.equal(events.at(-1), failure);
  });

test('a session that is closed does not call its client any more, whatever still comes', async (t) => {
  let closed = false;
  const late = [];
  let answered;
  const first = new Promise((resolve) => (answered = resolve));
  for (const name of ['lw_respond', 'lw_receive', 'lw_finish', 'lw_fail', 'lw_next', 'lw_work'])
    wrapExport(t, name, (call, values) => {
      if (closed) late.push(name);
      if (name === 'lw_respond') answered();
      return call(...values);
    });
  const { session } = startSession(t);
  await first;
  closed = true;
  session.close();
  session.command({ type: 'resume' });
  await sleep(REST);
  assert.deepEqual(late, []);
});

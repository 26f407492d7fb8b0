// SPDX-License-Identifier: Apache-2.0
//
// How the WebAssembly client finds its way in the module's memory. The module is made up: its memory is so large that addresses
// do not fit into 31 bits.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { temporaryFolder } from './packs.mjs';
import { bundle } from './test_page.mjs';

const folder = temporaryFolder();
writeFileSync(`${folder}/wasm_client.mjs`, await bundle('web/src/core/wasm_client.ts'));
const { WasmClient } = await import(`${folder}/wasm_client.mjs`);

const GIB = 2 ** 30;
const PAGE = 2 ** 16;
/** Where the made-up module keeps what it says, what it is told, and an update's bytes. */
const [RECORD, INPUT, BYTES] = [2 * GIB, 2 * GIB + 4096, 2 * GIB + 8192];

/** The functions of a module whose memory ends beyond 2 GiB; like WebAssembly's own they give addresses as signed numbers. */
function highModule(functions) {
  const memory = new WebAssembly.Memory({ initial: (2 * GIB) / PAGE + 1 });
  return { memory, lw_abi_version: () => 2, lw_create: () => BYTES | 0, lw_record: () => RECORD | 0, lw_input: () => INPUT | 0, ...functions };
}

const say = ({ memory }, ...words) => new Uint32Array(memory.buffer, RECORD, words.length).set(words);

test('what a client says beyond 2 GiB is read', () => {
  const module = highModule({ lw_next: () => 1 });
  say(module, 7, 3 * GIB, 3 * GIB + 99);
  assert.deepEqual(new WasmClient(module, 'light').next(0), { type: 'ask', request: 7, first: 3 * GIB, last: 3 * GIB + 99 });
});

test('the bytes of an update beyond 2 GiB are read', () => {
  const module = highModule({ lw_take: () => 1 });
  new Uint8Array(module.memory.buffer, BYTES, 3).set([1, 2, 3]);
  say(module, BYTES, 3);
  const { type, glb } = new WasmClient(module, 'light').take(1000);
  assert.deepEqual([type, ...new Uint8Array(glb)], ['opening', 1, 2, 3]);
});

test('what a client is told goes beyond 2 GiB', () => {
  const told = [];
  const module = highModule({ lw_receive: (...values) => told.push(values), lw_respond: (...values) => told.push(values) });
  const client = new WasmClient(module, 'light');
  const input = (length) => new Uint8Array(module.memory.buffer, INPUT, length);
  client.receive(5, Uint8Array.of(9, 8, 7), 0.5);
  assert.deepEqual([...input(3)], [9, 8, 7]);
  client.respond(5, 206, 'bytes 0-9/10', '"x"', 0.5);
  assert.equal(new TextDecoder().decode(input(15)), 'bytes 0-9/10"x"');
  assert.deepEqual(told.map((values) => values.slice(1)), [[5, 3, 0.5], [5, 206, 12, 3, 0.5]]);
});

test('a memory that grows to make room for what a client is told is looked up anew', () => {
  const module = highModule({ lw_receive: () => {} });
  module.lw_input = () => (module.memory.grow(1), INPUT | 0);
  new WasmClient(module, 'light').receive(5, Uint8Array.of(9), 0);
  assert.deepEqual([...new Uint8Array(module.memory.buffer, INPUT, 1)], [9]);
});

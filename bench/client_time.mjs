// SPDX-License-Identifier: Apache-2.0
//
// client_time.mjs LIGHTWELL.wasm PACK: how long the client that pages run, in the engine that Chromium has, too, takes for a
// whole pack that arrives at once: decoding, filling what is missing, writing the atlas. The least of twelve runs, the first of which
// compile the module.
import { readFileSync } from 'node:fs';

const [wasmFile, pack] = process.argv.slice(2);
const RUNS = 12;
const BUDGET = 1 << 30;
/** Kinds of updates (lightwell/client/wasm.h). */
const END = 7;
const FAILURE = 8;

const file = readFileSync(pack);
const { instance } = await WebAssembly.instantiate(readFileSync(wasmFile), {});
const wasm = instance.exports;
wasm._initialize();

function put(data) {
  const pointer = wasm.lw_input(data.length);
  new Uint8Array(wasm.memory.buffer, pointer, data.length).set(data);
  return data.length;
}

function answer(client, request, first, last) {
  const range = `bytes ${first}-${last}/${file.length}`;
  put(new TextEncoder().encode(range));
  wasm.lw_respond(client, request, 206, range.length, 0, 0);
  wasm.lw_receive(client, request, put(file.subarray(first, last + 1)), 0);
  wasm.lw_finish(client, request, 0);
}

/** Milliseconds. */
function receive() {
  const client = wasm.lw_create(0, 0, 1);
  let spent = 0;
  for (let kind = 0; kind !== END; ) {
    while (wasm.lw_next(client, 0) === 1) {
      const [request, first, last] = new Uint32Array(wasm.memory.buffer, wasm.lw_record(), 3);
      answer(client, request, first, Math.min(last, file.length - 1));
    }
    const start = performance.now();
    while (wasm.lw_work(client));
    kind = wasm.lw_take(client, BUDGET);
    spent += performance.now() - start;
    if (kind === FAILURE) throw new Error(`${pack} cannot be read`);
  }
  wasm.lw_destroy(client);
  return spent;
}

console.log(`${Math.min(...Array.from({ length: RUNS }, receive)).toFixed(1)} ms`);

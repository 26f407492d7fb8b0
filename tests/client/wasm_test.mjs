// SPDX-License-Identifier: Apache-2.0
//
// wasm_test.mjs LIGHTWELL.wasm SAMPLE_PACK CLIENT_TRACE: streams a sample pack with the WebAssembly client and compares what it hands
// over, update by update and byte by byte, with what the native client prints: every strategy with every fill, and every
// fault of client_trace with each of both.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [wasmFile, samplePack, clientTrace] = process.argv.slice(2);
const pieceBytes = 5000;
const budget = 65536;
const latency = 0.01;

const crcTable = Uint32Array.from({ length: 256 }, (_, i) => {
  for (let bit = 0; bit < 8; bit++) i = i & 1 ? (i >>> 1) ^ 0x82f63b78 : i >>> 1;
  return i >>> 0;
});

function crc32c(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (crc >>> 8) ^ crcTable[(crc ^ byte) & 255];
  return ~crc >>> 0;
}

// An attribute's word as wasm.h describes it.
function attribute(word) {
  return [word & 255, (word >>> 8) & 255, (word >>> 16) & 15, (word >>> 20) & 2047, word >>> 31].join();
}

function trace(wasm, file, strategy, fill, fault) {
  const client = wasm.lw_create(strategy, fill, 1);
  const words = () => new Uint32Array(wasm.memory.buffer, wasm.lw_record(), 32);
  const bytes = (pointer, length) => new Uint8Array(wasm.memory.buffer, pointer, length);
  const put = (data) => {
    const pointer = wasm.lw_input(data.length);
    bytes(pointer, data.length).set(data);
    return data.length;
  };
  let now = 0;

  const answer = (request, first, last) => {
    now += latency;
    last = Math.min(last, file.length - 1);
    const range = `bytes ${first}-${last}/${file.length}`;
    const tag = '"tag"';
    put(new TextEncoder().encode(range + tag));
    wasm.lw_respond(client, request, 206, range.length, tag.length, now);
    const faulty = request % 5 === 0;
    let body = file.slice(first, last + 1);
    if (faulty && fault === 1) body = body.subarray(0, Math.floor(body.length / 2));
    if (faulty && fault === 2) body[Math.floor(body.length / 2)] ^= 1;
    for (let at = 0; at < body.length; at += pieceBytes)
      wasm.lw_receive(client, request, put(body.subarray(at, at + pieceBytes)), (now += latency));
    if (faulty && fault === 1) wasm.lw_fail(client, request, now);
    else wasm.lw_finish(client, request, now);
  };

  // How many words of the record a kind of update prints, and where its bytes' pointer and length stand.
  const forms = { 1: [0, 0], 2: [4], 3: [3, 3], 4: [3], 5: [5, 5], 6: [4, 4], 7: [0] };
  const lines = [];
  for (;;) {
    const action = wasm.lw_next(client, now);
    if (action === 1) {
      const [request, first, last] = words();
      answer(request, first, last);
    }
    const worked = wasm.lw_work(client);
    const kind = wasm.lw_take(client, budget);
    if (kind === 8) throw new Error(new TextDecoder().decode(bytes(words()[1], words()[2])));
    if (kind !== 0) {
      const [count, data] = forms[kind];
      const record = words();
      const printed = [kind, ...record.subarray(0, count)];
      if (kind === 2) printed.push(...Array.from(record.subarray(4, 4 + record[3]), attribute));
      if (data !== undefined) printed.push(crc32c(bytes(record[data], record[data + 1])));
      lines.push(printed.join(' '));
    }
    if (kind === 7) break;
    if (action || worked || kind) continue;
    const wake = wasm.lw_wake(client);
    if (!Number.isFinite(wake)) break;
    now = Math.max(now, wake);
  }
  wasm.lw_destroy(client);
  return lines;
}

const module = await WebAssembly.compile(readFileSync(wasmFile));
const imports = WebAssembly.Module.imports(module);
if (imports.length > 0) throw new Error(`the module imports ${imports.map((i) => i.name)}`);
const { exports: wasm } = await WebAssembly.instantiate(module, {});
wasm._initialize();

const folder = mkdtempSync(join(tmpdir(), 'lightwell-'));
try {
  const pack = join(folder, 'sample.lw.glb');
  execFileSync(samplePack, [pack, '6000']);
  const file = readFileSync(pack);
  let updates = 0;
  for (let run = 0; run < 9; run++) {
    const strategy = run % 3;
    const fill = Math.floor(run / 3);
    const fault = (strategy + fill) % 3;
    const name = `strategy ${strategy}, fill ${fill}, fault ${fault}`;
    const expected = execFileSync(clientTrace, [pack, strategy, fill, fault], { encoding: 'utf8' }).trim().split('\n');
    const actual = trace(wasm, file, strategy, fill, fault);
    if (expected.at(-1) !== '7') throw new Error(`${name}: the native client ended with: ${expected.at(-1)}`);
    for (let i = 0; i < Math.max(expected.length, actual.length); i++)
      if (expected[i] !== actual[i])
        throw new Error(`${name}, update ${i}: native "${expected[i]}", WebAssembly "${actual[i]}"`);
    updates += actual.length;
  }
  console.log(`${updates} updates are the same`);
} finally {
  rmSync(folder, { recursive: true });
}

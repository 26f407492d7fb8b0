// SPDX-License-Identifier: Apache-2.0
//
// room_digests_test.mjs ROOM_INPUTS ROOM_DIGESTS ROOM_DIGESTS.wasm: gives the same inputs to the native rooms and to the
// WebAssembly ones and compares what comes of them, case by case.
import { execFileSync } from 'node:child_process';
import { closeSync, mkdtempSync, openSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { WASI } from 'node:wasi';

const [roomInputs, nativeProgram, wasmFile] = process.argv.slice(2);
const leastCasesOfARoom = 5;

/** The lines that the WebAssembly program prints for the cases in a file. */
async function runWasm(inputs, outputs) {
  const stdin = openSync(inputs, 'r');
  const stdout = openSync(outputs, 'w');
  const wasi = new WASI({ version: 'preview1', stdin, stdout });
  const { instance } = await WebAssembly.instantiate(readFileSync(wasmFile), wasi.getImportObject());
  const status = wasi.start(instance);
  closeSync(stdin);
  closeSync(stdout);
  if (status !== 0) throw new Error(`the WebAssembly program ended with status ${status}`);
  return readFileSync(outputs, 'utf8').trim().split('\n');
}

const folder = mkdtempSync(join(tmpdir(), 'lightwell-'));
try {
  const inputs = join(folder, 'inputs');
  writeFileSync(inputs, execFileSync(roomInputs, { maxBuffer: 2 ** 30 }));
  const native = execFileSync(nativeProgram, { input: readFileSync(inputs), encoding: 'utf8' }).trim().split('\n');
  const wasm = await runWasm(inputs, join(folder, 'outputs'));
  for (const room of ['base', 'light', 'mesh', 'texture', 'pack']) {
    const count = native.filter((line) => line.startsWith(room)).length;
    if (count < leastCasesOfARoom) throw new Error(`only ${count} cases of ${room}`);
  }
  for (let i = 0; i < Math.max(native.length, wasm.length); i++)
    if (native[i] !== wasm[i]) throw new Error(`case ${i}: native "${native[i]}", WebAssembly "${wasm[i]}"`);
  console.log(`${native.length} cases give the same`);
} finally {
  rmSync(folder, { recursive: true });
}

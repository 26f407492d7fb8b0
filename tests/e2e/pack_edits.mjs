// SPDX-License-Identifier: Apache-2.0
//
// Packs that say in their JSON what their streams do not, with every check right.
import { readFileSync, writeFileSync } from 'node:fs';

const POLYNOMIAL = 0x82f63b78; // of CRC-32C, bits reversed

function crc32c(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ POLYNOMIAL : crc >>> 1;
  }
  return ~crc >>> 0;
}

/** Writes `from` to `to` with a text of its JSON replaced by another of the same length, so that all else stays in place (docs/format.md). */
export function replaceInJson(from, to, text, other) {
  if (text.length !== other.length) throw new Error(`${text} and ${other} are not of one length`);
  const file = readFileSync(from);
  const at = file.indexOf(text);
  if (at < 0) throw new Error(`${from} does not say ${text}`);
  file.write(other, at);
  let opening = 12;
  while (file.toString('latin1', opening + 4, opening + 8) !== 'LWST') opening += 8 + file.readUInt32LE(opening);
  opening += 8;
  const directory = file.subarray(opening, opening + file.readUInt32LE(opening));
  directory.writeUInt32LE(crc32c(file.subarray(0, opening)), 28);
  directory.writeUInt32LE(crc32c(directory.subarray(0, -4)), directory.length - 4);
  writeFileSync(to, file);
  return to;
}

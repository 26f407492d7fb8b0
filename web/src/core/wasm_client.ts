// SPDX-License-Identifier: Apache-2.0
import type { AttributeLayout, Component, PackEvent, Semantic, Strategy } from './protocol.js';

/** The functions of lightwell.wasm; lightwell/client/wasm.h documents them. */
interface Exports {
  memory: WebAssembly.Memory;
  lw_abi_version(): number;
  lw_create(strategy: number, fill: number, seed: number): number;
  lw_input(length: number): number;
  lw_record(): number;
  lw_next(client: number, now: number): number;
  lw_respond(client: number, request: number, status: number, rangeLength: number, etagLength: number, now: number): void;
  lw_receive(client: number, request: number, length: number, now: number): void;
  lw_finish(client: number, request: number, now: number): void;
  lw_fail(client: number, request: number, now: number): void;
  lw_wake(client: number): number;
  lw_work(client: number): number;
  lw_take(client: number, budget: number): number;
  lw_set_strategy(client: number, strategy: number): void;
  lw_set_weight(client: number, asset: number, weight: number): void;
  lw_blocked_links(client: number, asset: number): void;
  lw_progress(client: number): void;
}

const ABI_VERSION = 2;
/** How nodes of the light grid that have not come are filled: see lightwell/client/wasm.h. */
const FILL_PUSH_PULL = 0;
const STRATEGIES: Strategy[] = ['interleave', 'geometry', 'light'];
const SEMANTICS: Semantic[] = ['position', 'normal', 'texcoord_0', 'texcoord_1', 'color'];
const COMPONENTS: Component[] = ['i8', 'u8', 'i16', 'u16', 'f32'];
const IMAGE_TYPES = ['image/png', 'image/jpeg', 'image/webp'];
const FAILURES = ['unreadable', 'replaced', 'refused'] as const;

/** What the client asks of its transport. */
export type Action =
  | { type: 'ask'; request: number; first: number; last: number }
  | { type: 'cancel'; request: number };

export interface Counts {
  bytes: [number, number];
  geometry: [number, number];
  light: [number, number];
  faces: [number, number];
  nodes: [number, number];
  requests: number;
  failures: number;
}

/** The client of lightwell/client/ with JavaScript's types, one for each instance of the module. Times are seconds. */
export class WasmClient {
  readonly #wasm: Exports;
  readonly #handle: number;

  constructor(exports: WebAssembly.Exports, strategy: Strategy) {
    this.#wasm = exports as unknown as Exports;
    const version = this.#wasm.lw_abi_version();
    if (version !== ABI_VERSION) throw new Error(`lightwell.wasm is of interface ${version}, this script of ${ABI_VERSION}`);
    const seed = Math.floor(Math.random() * 2 ** 32);
    this.#handle = this.#wasm.lw_create(STRATEGIES.indexOf(strategy), FILL_PUSH_PULL, seed);
  }

  next(now: number): Action | null {
    const kind = this.#wasm.lw_next(this.#handle, now);
    if (kind === 0) return null;
    const [request = 0, first = 0, last = 0] = this.#record(3);
    return kind === 1 ? { type: 'ask', request, first, last } : { type: 'cancel', request };
  }

  respond(request: number, status: number, contentRange: string, etag: string, now: number): void {
    const encoder = new TextEncoder();
    const texts = [encoder.encode(contentRange), encoder.encode(etag)] as const;
    const input = this.#input(texts[0].length + texts[1].length);
    input.set(texts[0]);
    input.set(texts[1], texts[0].length);
    this.#wasm.lw_respond(this.#handle, request, status, texts[0].length, texts[1].length, now);
  }

  receive(request: number, bytes: Uint8Array, now: number): void {
    this.#input(bytes.length).set(bytes);
    this.#wasm.lw_receive(this.#handle, request, bytes.length, now);
  }

  finish(request: number, now: number): void {
    this.#wasm.lw_finish(this.#handle, request, now);
  }

  fail(request: number, now: number): void {
    this.#wasm.lw_fail(this.#handle, request, now);
  }

  /** Seconds until next() has to be called although nothing happened. */
  wakeIn(now: number): number {
    return this.#wasm.lw_wake(this.#handle) - now;
  }

  /** Decodes at most one block, or fills a light grid; false when there was nothing to do. */
  work(): boolean {
    return this.#wasm.lw_work(this.#handle) !== 0;
  }

  setStrategy(strategy: Strategy): void {
    this.#wasm.lw_set_strategy(this.#handle, STRATEGIES.indexOf(strategy));
  }

  setWeight(asset: number, weight: number): void {
    this.#wasm.lw_set_weight(this.#handle, asset, weight);
  }

  blockedLinks(asset: number): PackEvent {
    this.#wasm.lw_blocked_links(this.#handle, asset);
    const [pointer = 0, floats = 0] = this.#record(2);
    return { type: 'links', asset, ends: new Float32Array(this.#copy(pointer, 4 * floats)) };
  }

  counts(): Counts {
    this.#wasm.lw_progress(this.#handle);
    const r = this.#record(12);
    const pair = (i: number): [number, number] => [r[i]!, r[i + 1]!];
    return {
      bytes: pair(0),
      geometry: pair(2),
      light: pair(4),
      faces: pair(6),
      nodes: pair(8),
      requests: r[10]!,
      failures: r[11]!,
    };
  }

  /** The next update, of at most about `budget` bytes. */
  take(budget: number): PackEvent | null {
    const kind = this.#wasm.lw_take(this.#handle, budget);
    const r = this.#record(32);
    const asset = r[0]!;
    switch (kind) {
      case 1:
        return { type: 'opening', glb: this.#copy(r[0]!, r[1]!) };
      case 2:
        return {
          type: 'mesh',
          asset,
          vertices: r[1]!,
          faces: r[2]!,
          attributes: Array.from(r.subarray(4, 4 + r[3]!), attributeLayout),
        };
      case 3:
        return { type: 'range', asset, buffer: r[1]!, offset: r[2]!, data: new Uint8Array(this.#copy(r[3]!, r[4]!)) };
      case 4:
        return { type: 'draw', asset, vertices: r[1]!, faces: Array.from(new Uint32Array(this.#copy(r[3]!, 4 * r[4]!))) };
      case 5:
        return {
          type: 'light',
          asset,
          width: r[1]!,
          height: r[2]!,
          depth: r[3]!,
          atlas: new Uint16Array(this.#copy(r[5]!, r[6]!)),
        };
      case 6:
        return { type: 'texture', asset, width: r[2]!, height: r[3]!, mimeType: IMAGE_TYPES[r[1]!]!, file: this.#copy(r[4]!, r[5]!) };
      case 9:
        return { type: 'parts', inflated: r[1]!, file: this.#copy(r[2]!, r[3]!) };
      case 7:
        return { type: 'connection', state: 'complete' };
      case 8:
        return { type: 'failure', reason: FAILURES[r[0]!]!, message: new TextDecoder().decode(this.#copy(r[1]!, r[2]!)) };
      default:
        return null;
    }
  }

  /** Where the next call's bytes go: a new view each time, since the module's memory may have grown. */
  #input(length: number): Uint8Array {
    const address = addressOf(this.#wasm.lw_input(length));
    return new Uint8Array(this.#wasm.memory.buffer, address, length);
  }

  #record(words: number): Uint32Array {
    const address = addressOf(this.#wasm.lw_record());
    return new Uint32Array(this.#wasm.memory.buffer, address, words);
  }

  #copy(address: number, length: number): ArrayBuffer {
    return this.#wasm.memory.buffer.slice(address, address + length) as ArrayBuffer;
  }
}

/** A place in the memory: WebAssembly hands 32-bit numbers over as signed ones, which are negative from 2 GiB on. */
function addressOf(pointer: number): number {
  return pointer >>> 0;
}

function attributeLayout(word: number): AttributeLayout {
  return {
    semantic: SEMANTICS[word & 0xff]!,
    component: COMPONENTS[(word >>> 8) & 0xff]!,
    components: (word >>> 16) & 0xf,
    stride: (word >>> 20) & 0xff,
    normalized: word >>> 31 === 1,
  };
}

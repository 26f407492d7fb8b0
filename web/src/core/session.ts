// SPDX-License-Identifier: Apache-2.0
import { loadWasm } from './load_wasm.js';
import { type Command, type ConnectionEvent, type PackEvent, type Progress, payload } from './protocol.js';
import { RateMeter } from './rate_meter.js';
import { WasmClient } from './wasm_client.js';

/** Decoding holds the thread no longer than this, in milliseconds. */
const SLICE = 4;
/** Updates that the page has not handed to the GPU yet: no more is taken from the client beyond this, in bytes. */
const IN_FLIGHT = 4 << 20;
/** An update of a mesh is cut into pieces of about this size, in bytes. */
const PIECE = 64 << 10;
/** Progress is told at most this often, in milliseconds. */
const PROGRESS_INTERVAL = 100;

/** Drives the client of one pack: carries its requests with fetch, gives it time to decode, emits what it hands over. */
export class PackSession {
  readonly #emit: (events: PackEvent[]) => void;
  #url = '';
  #client: WasmClient | null = null;
  #waiting: Command[] = [];
  readonly #requests = new Map<number, AbortController>();
  readonly #rate = new RateMeter();
  #inFlight = 0;
  #paused = false;
  #closed = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #progressTime = -Infinity;
  #state: ConnectionEvent['state'] = 'streaming';

  constructor(emit: (events: PackEvent[]) => void) {
    this.#emit = emit;
  }

  command(command: Command): void {
    if (command.type === 'open') void this.#open(command.url, command.wasm, command.strategy);
    else if (this.#client === null) this.#waiting.push(command);
    else this.#obey(this.#client, command);
  }

  close(): void {
    this.#closed = true;
    clearTimeout(this.#timer);
    for (const controller of this.#requests.values()) controller.abort();
    this.#client?.destroy();
    this.#client = null;
  }

  async #open(url: string, wasm: string, strategy: Parameters<WasmClient['setStrategy']>[0]): Promise<void> {
    try {
      const exports = await loadWasm(wasm);
      if (this.#closed) return;
      this.#url = url;
      this.#client = new WasmClient(exports, strategy);
    } catch (error) {
      return this.#emit([{ type: 'failure', reason: 'unreadable', message: String(error) }]);
    }
    for (const command of this.#waiting.splice(0)) this.#obey(this.#client, command);
    this.#pump();
  }

  #obey(client: WasmClient, command: Command): void {
    switch (command.type) {
      case 'strategy':
        client.setStrategy(command.strategy);
        break;
      case 'weights':
        for (const [stream, weight] of command.weights) client.setWeight(stream, weight);
        break;
      case 'pause':
        this.#paused = true;
        break;
      case 'resume':
        this.#paused = false;
        break;
      case 'consumed':
        this.#inFlight -= command.bytes;
        break;
    }
    this.#pump();
  }

  /** Does what there is to do for one slice of time, then comes back when there is more. */
  #pump(): void {
    clearTimeout(this.#timer);
    const client = this.#client;
    if (client === null || this.#closed) return;
    const start = performance.now();
    const events: PackEvent[] = [];
    let more = true;
    while (more && performance.now() - start < SLICE) {
      this.#act(client);
      // What is decoded while the page has no room would come to it in one piece that is too large.
      more = this.#inFlight < IN_FLIGHT && this.#advance(client, events);
    }
    this.#report(client, events, start);
    if (events.length > 0) this.#emit(events);
    this.#comeBack(client, more);
  }

  #act(client: WasmClient): void {
    if (this.#paused) return;
    for (let action = client.next(now()); action !== null; action = client.next(now())) {
      if (action.type === 'ask') void this.#fetch(client, action.request, action.first, action.last);
      else this.#requests.get(action.request)?.abort();
    }
  }

  /** Decodes one block and takes one update over; false when there is neither. */
  #advance(client: WasmClient, events: PackEvent[]): boolean {
    const decoded = client.work();
    return this.#take(client, events) || decoded;
  }

  #take(client: WasmClient, events: PackEvent[]): boolean {
    const event = client.take(PIECE);
    if (event === null) return false;
    if (event.type === 'connection') this.#state = event.state;
    if (event.type !== 'opening') this.#inFlight += payload(event)?.byteLength ?? 0;
    events.push(event);
    return true;
  }

  async #fetch(client: WasmClient, request: number, first: number, last: number): Promise<void> {
    const controller = new AbortController();
    this.#requests.set(request, controller);
    try {
      const response = await fetch(this.#url, { headers: { Range: `bytes=${first}-${last}` }, signal: controller.signal });
      const header = (name: string) => response.headers.get(name) ?? '';
      client.respond(request, response.status, header('Content-Range'), header('ETag'), now());
      this.#pump();
      await this.#read(client, request, response, controller.signal);
      if (!controller.signal.aborted) client.finish(request, now());
    } catch {
      if (!controller.signal.aborted) client.fail(request, now());
    }
    this.#requests.delete(request);
    this.#pump();
  }

  async #read(client: WasmClient, request: number, response: Response, signal: AbortSignal): Promise<void> {
    const reader = response.body?.getReader();
    while (reader !== undefined) {
      const { done, value } = await reader.read();
      if (done || signal.aborted) return;
      client.receive(request, value, now());
      this.#pump();
    }
  }

  #report(client: WasmClient, events: PackEvent[], time: number): void {
    const counts = client.counts();
    if (this.#state !== 'complete') {
      const state = counts.failures > 0 ? 'waiting' : 'streaming';
      if (state !== this.#state) events.push({ type: 'connection', state });
      this.#state = state;
    }
    const ended = events.some((event) => event.type === 'connection' || event.type === 'failure');
    if (!ended && this.#state === 'complete') return;
    if (!ended && time - this.#progressTime < PROGRESS_INTERVAL) return;
    this.#progressTime = time;
    this.#rate.add(time / 1000, counts.bytes[0]);
    const share = ([done, total]: [number, number]) => ({ done, total });
    const progress: Progress = {
      bytes: share(counts.bytes),
      geometry: share(counts.geometry),
      light: share(counts.light),
      faces: share(counts.faces),
      nodes: share(counts.nodes),
      requests: counts.requests,
      rate: this.#rate.value(),
    };
    events.push({ type: 'progress', progress });
  }

  #comeBack(client: WasmClient, more: boolean): void {
    const seconds = client.wakeIn(now());
    if (more) this.#timer = setTimeout(() => this.#pump(), 0);
    else if (Number.isFinite(seconds) && !this.#paused)
      this.#timer = setTimeout(() => this.#pump(), Math.max(1, seconds * 1000));
  }
}

function now(): number {
  return performance.now() / 1000;
}

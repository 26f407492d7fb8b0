// SPDX-License-Identifier: Apache-2.0
import { loadWasm } from './load_wasm.js';
import { type Command, type ConnectionEvent, type FailureEvent, type PackEvent, type Progress, type Strategy, payload } from './protocol.js';
import { RateMeter } from './rate_meter.js';
import { WasmClient } from './wasm_client.js';

/** Decoding holds the thread no longer than this, in milliseconds. */
const SLICE = 4;
/** The client is asked for no more updates while this many bytes of them have not reached the GPU yet. */
const IN_FLIGHT = 4 << 20;
/** An update of a mesh is cut into pieces of about this size, in bytes. */
const PIECE = 64 << 10;
/** Stands for a Content-Range that says nothing of use. */
const NO_RANGE = 'none';
/** The last byte of a request for the whole file, whatever its length. */
const TO_THE_END = 2 ** 32 - 1;
/** Least time between two progress events, in milliseconds. */
const PROGRESS_INTERVAL = 100;

const FORBIDDEN = 'the server does not let pages of other sites read it (no Access-Control-Allow-Origin)';

/** Drives the client of one pack: carries its requests with fetch, gives it time to decode, emits what it hands over. */
export class PackSession {
  readonly #emit: (events: PackEvent[]) => void;
  #url = '';
  #client: WasmClient | null = null;
  #waiting: Command[] = [];
  readonly #requests = new Map<number, AbortController>();
  readonly #rate = new RateMeter();
  #answered = false;
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
    else if (this.#client === null && !this.#closed) this.#waiting.push(command);
    else this.#run((client) => this.#obey(client, command));
  }

  /** The client's memory goes with its module. */
  close(): void {
    this.#closed = true;
    clearTimeout(this.#timer);
    for (const controller of this.#requests.values()) controller.abort();
    this.#client = null;
  }

  async #open(url: string, wasm: string, strategy: Strategy): Promise<void> {
    try {
      const exports = await loadWasm(wasm);
      if (this.#closed) return;
      this.#url = url;
      this.#client = new WasmClient(exports, strategy);
    } catch (error) {
      return this.#giveUp(error);
    }
    this.#run((client) => this.#waiting.splice(0).forEach((command) => this.#obey(client, command)));
  }

  /**
   * Tells the client something, then does what there is to do. All that happens comes through here: a client that trapped,
   * for want of memory for instance, is in no known state and is not called again.
   */
  #run(tell: (client: WasmClient) => void): void {
    if (this.#client === null) return;
    try {
      tell(this.#client);
      this.#pump(this.#client);
    } catch (error) {
      this.#giveUp(error);
    }
  }

  #giveUp(error: unknown, reason: FailureEvent['reason'] = 'unreadable'): void {
    if (this.#closed) return;
    this.close();
    this.#emit([{ type: 'failure', reason, message: error instanceof Error ? error.message : String(error) }]);
  }

  #obey(client: WasmClient, command: Command): void {
    switch (command.type) {
      case 'strategy':
        client.setStrategy(command.strategy);
        break;
      case 'weights':
        for (const [asset, weight] of command.weights) client.setWeight(asset, weight);
        break;
      case 'links':
        this.#emit([client.blockedLinks(command.asset)]);
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
  }

  /** Does what there is to do for one slice of time, then comes back when there is more. */
  #pump(client: WasmClient): void {
    clearTimeout(this.#timer);
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
      if (action.type === 'ask') void this.#fetch(action.request, action.first, action.last);
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

  /** Carries a request. One that was cancelled says nothing more. */
  async #fetch(request: number, first: number, last: number): Promise<void> {
    const controller = new AbortController();
    const { signal } = controller;
    this.#requests.set(request, controller);
    const report = (tell: (client: WasmClient) => void) => signal.aborted || this.#run(tell);
    try {
      const headers: HeadersInit = last === TO_THE_END ? {} : { Range: `bytes=${first}-${last}` };
      const response = await fetch(this.#url, { headers, signal });
      this.#answered = true;
      const header = (name: string) => response.headers.get(name) ?? '';
      report((client) => client.respond(request, response.status, header('Content-Range'), header('ETag'), now()));
      await readBody(response, (bytes) => report((client) => client.receive(request, bytes, now())));
      report((client) => client.finish(request, now()));
    } catch {
      const fault = signal.aborted ? 'line' : await this.#fault();
      if (fault === 'permission') this.#giveUp(FORBIDDEN, 'refused');
      if (fault === 'ranges') report((client) => client.respond(request, 206, NO_RANGE, '', now()));
      else report((client) => client.fail(request, now()));
    }
    this.#requests.delete(request);
  }

  /**
   * What is wrong where nothing was answered, which browsers report as they report a broken connection. The first request shows whether the
   * server is there: it needs no permission, and may not ask for a range. The second asks for a byte as the client does, since a server
   * may treat HEAD differently; the third for the file as anybody does, since one that codes what it sends in parts sends nonsense.
   */
  async #fault(): Promise<'line' | 'permission' | 'ranges'> {
    const reach = (init: RequestInit) => fetch(this.#url, init).then(({ body }) => (void body?.cancel(), true), () => false);
    if (this.#answered || !(await reach({ method: 'HEAD', mode: 'no-cors' }))) return 'line';
    if (await reach({ headers: { Range: 'bytes=0-0' } })) return 'line';
    if (await reach({})) return 'ranges';
    return new URL(this.#url).origin === origin ? 'line' : 'permission';
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
    const pump = () => this.#run(() => {});
    if (more) this.#timer = setTimeout(pump, 0);
    else if (Number.isFinite(seconds) && !this.#paused) this.#timer = setTimeout(pump, Math.max(1, seconds * 1000));
  }
}

/** Hands a body over piece by piece; rejects when it breaks or is cancelled. */
async function readBody(response: Response, receive: (bytes: Uint8Array) => void): Promise<void> {
  const reader = response.body?.getReader();
  for (let piece = await reader?.read(); piece !== undefined && !piece.done; piece = await reader?.read()) receive(piece.value);
}

function now(): number {
  return performance.now() / 1000;
}

// SPDX-License-Identifier: Apache-2.0
import type { Command, PackEvent, Strategy } from './protocol.js';

export interface ConnectionOptions {
  /** Where worker.js lies; by default beside this script. */
  workerUrl?: string;
  /** Where lightwell.wasm lies; by default beside this script. */
  wasmUrl?: string;
  strategy?: Strategy;
}

/** The two-way connection to a pack session, which runs in a worker or, where the page may start none, in the page itself. */
interface Port {
  postMessage(message: Command, transfer?: Transferable[]): void;
  close(): void;
}

/**
 * A pack that is being streamed. Events arrive at `onEvent`, never before `open` has returned. A file is opened once; for
 * another one make another connection.
 */
export class PackConnection {
  onEvent: (event: PackEvent) => void = () => {};
  readonly #port: Promise<Port>;
  #closed = false;

  constructor(url: string, options: ConnectionOptions = {}) {
    const workerUrl = absolute(options.workerUrl ?? new URL('./worker.js', import.meta.url).href);
    const wasm = absolute(options.wasmUrl ?? new URL('./lightwell.wasm', import.meta.url).href);
    const tell = reporting((event) => this.onEvent(event));
    const listen = (events: PackEvent[]) => events.forEach((event) => this.#closed || tell(event));
    this.#port = connectWorker(workerUrl, listen).catch(() => connectHere(workerUrl, listen));
    this.#port.catch((error: unknown) => listen([failure(`${workerUrl}: ${String(error)}`)]));
    this.#send({ type: 'open', url: absolute(url), wasm, strategy: options.strategy ?? 'interleave' });
  }

  setStrategy(strategy: Strategy): void {
    this.#send({ type: 'strategy', strategy });
  }

  pause(): void {
    this.#send({ type: 'pause' });
  }

  resume(): void {
    this.#send({ type: 'resume' });
  }

  /** How much assets matter to the present picture; 0 puts one last. */
  setWeights(weights: [asset: number, weight: number][]): void {
    this.#send({ type: 'weights', weights });
  }

  /** Asks for a `links` event of a light grid. */
  askForLinks(asset: number): void {
    this.#send({ type: 'links', asset });
  }

  /** Says that so many bytes of updates have reached the GPU, so that as many more come. */
  consumed(bytes: number): void {
    this.#send({ type: 'consumed', bytes });
  }

  close(): void {
    this.#closed = true;
    this.#port.then((port) => port.close()).catch(() => {});
  }

  #send(command: Command): void {
    this.#port.then((port) => port.postMessage(command)).catch(() => {});
  }
}

/** A listener that loses an event at which it throws, but not the rest of what came with it. */
export function reporting(listener: (event: PackEvent) => void): (event: PackEvent) => void {
  return (event) => {
    try {
      listener(event);
    } catch (error) {
      reportError(error);
    }
  };
}

function failure(message: string): PackEvent {
  return { type: 'failure', reason: 'unreadable', message };
}

function absolute(url: string): string {
  return new URL(url, document.baseURI).href;
}

/**
 * Starts the worker: from a Blob that imports the script where that is of another origin, since browsers refuse it. Resolves
 * when the worker has said that it runs, rejects when the page's rules forbid it.
 */
function connectWorker(workerUrl: string, listen: (events: PackEvent[]) => void): Promise<Port> {
  return new Promise((resolve, reject) => {
    const source = `import ${JSON.stringify(workerUrl)};`;
    const own = new URL(workerUrl).origin === origin;
    const url = own ? workerUrl : URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
    const worker = new Worker(url, { type: 'module' });
    const settle = () => URL.revokeObjectURL(url);
    worker.onerror = (event) => {
      settle();
      worker.terminate();
      reject(new Error(event.message || 'the worker did not start'));
    };
    worker.onmessage = (message: MessageEvent<PackEvent[] | 'ready'>) => {
      if (message.data !== 'ready') return listen(message.data);
      settle();
      worker.onerror = (event) => listen([failure(event.message)]);
      resolve({
        postMessage: (command) => worker.postMessage(command),
        close: () => worker.terminate(),
      });
    };
  });
}

/** The same script as a module of the page: decoding then shares the page's thread. */
async function connectHere(workerUrl: string, listen: (events: PackEvent[]) => void): Promise<Port> {
  const module = (await import(/* webpackIgnore: true */ /* @vite-ignore */ workerUrl)) as typeof import('./worker.js');
  const session = module.startSession(listen);
  return { postMessage: (command) => session.command(command), close: () => session.close() };
}

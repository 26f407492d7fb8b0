// SPDX-License-Identifier: Apache-2.0
//
// The worker's script. As a module of a page it starts nothing by itself and offers `startSession`.
import { type Command, type PackEvent, payload } from './protocol.js';
import { PackSession } from './session.js';

/** A session that lives in the caller's thread. */
export function startSession(emit: (events: PackEvent[]) => void): PackSession {
  return new PackSession(emit);
}

interface WorkerScope {
  postMessage(message: unknown, transfer?: Transferable[]): void;
  onmessage: ((message: MessageEvent<Command>) => void) | null;
}

if (typeof window === 'undefined') {
  const scope = globalThis as unknown as WorkerScope;
  const session = new PackSession((events) => scope.postMessage(events, transferables(events)));
  scope.onmessage = (message) => session.command(message.data);
  scope.postMessage('ready');
}

function transferables(events: PackEvent[]): ArrayBuffer[] {
  return events.map(payload).filter((buffer) => buffer !== null);
}

// SPDX-License-Identifier: Apache-2.0
import type { ConnectionEvent, FailureEvent, Progress } from '../core/protocol.js';
import type { View } from './orbit.js';

/** The element's own events by name, with what their `detail` holds. */
export interface LightwellViewDetails {
  load: null;
  firstframe: null;
  frame: null;
  progress: Progress;
  connection: { state: ConnectionEvent['state'] };
  complete: null;
  'camera-change': View;
  measure: { metres: number; from: View['target']; to: View['target'] };
  error: { reason: FailureEvent['reason'] | 'unsupported'; message: string };
}

/** All of its events, with those that any element has. */
export type LightwellViewEventMap = Omit<HTMLElementEventMap, keyof LightwellViewDetails> & {
  [Name in keyof LightwellViewDetails]: CustomEvent<LightwellViewDetails[Name]>;
};

/** What LightwellView listens with: as any element does, but it knows its own events. */
export interface Listens {
  addEventListener<Name extends keyof LightwellViewEventMap>(
    type: Name,
    listener: (event: LightwellViewEventMap[Name]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<Name extends keyof LightwellViewEventMap>(
    type: Name,
    listener: (event: LightwellViewEventMap[Name]) => unknown,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}

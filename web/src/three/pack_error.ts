// SPDX-License-Identifier: Apache-2.0
import type { FailureEvent } from '../core/protocol.js';

/** A pack that cannot be loaded, with the reason that its stream gave; what else goes wrong is 'unreadable'. */
export class PackError extends Error {
  override readonly name = 'PackError';

  constructor(
    message: string,
    readonly reason: FailureEvent['reason'],
  ) {
    super(message);
  }
}

export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

export function reasonOf(error: unknown): FailureEvent['reason'] {
  return error instanceof PackError ? error.reason : 'unreadable';
}

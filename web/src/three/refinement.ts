// SPDX-License-Identifier: Apache-2.0
import type { UploadBudget } from './upload_budget.js';

/** Something that streams into buffers or textures which have their final sizes from the start. */
export interface Refinement {
  /** Hands over what the budget allows. True when that changes the picture. */
  advance(budget: UploadBudget): boolean;
  /** Whether there is something to hand over. */
  readonly pending: boolean;
  /** Bytes of the updates that were finished since the last call. */
  takeConsumed(): number;
  /** Begins again with what was only partly handed over, since the GPU has lost it. */
  restart(): void;
  dispose(): void;
}

// SPDX-License-Identifier: Apache-2.0
import type { UploadBudget } from './upload_budget.js';

/** Rows `row` ... `row + rows` of a slice. */
export interface Strip {
  slice: number;
  row: number;
  rows: number;
}

/** Goes through the rows of a picture, or of a stack of pictures, in strips that fit into what frames have left. */
export class RowSweep {
  readonly #rowBytes: number;
  readonly #height: number;
  readonly #slices: number;
  #next = 0;

  /** `height` rows in each of `slices` slices. */
  constructor(rowBytes: number, height: number, slices = 1) {
    this.#rowBytes = rowBytes;
    this.#height = height;
    this.#slices = slices;
  }

  get done(): boolean {
    return this.#next === this.#height * this.#slices;
  }

  /** Takes the next strip out of a frame's bytes; null when there is no room for a row, or none is left. */
  take(budget: UploadBudget): Strip | null {
    if (this.done) return null;
    const row = this.#next % this.#height;
    const rows = Math.max(1, Math.min(this.#height - row, Math.floor(budget.left / this.#rowBytes)));
    if (!budget.take(rows * this.#rowBytes)) return null;
    const slice = (this.#next - row) / this.#height;
    this.#next += rows;
    return { slice, row, rows };
  }

  restart(): void {
    this.#next = 0;
  }
}

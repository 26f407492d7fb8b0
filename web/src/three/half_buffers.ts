// SPDX-License-Identifier: Apache-2.0
import { BufferAttribute, DynamicDrawUsage } from 'three';
import type { UploadBudget } from './upload_budget.js';

/** Indices a page: the grain in which changes are handed over, 4 KB. */
const PAGE = 1024;

/**
 * An index buffer of two halves. One is drawn while the other is brought up to date page by page over as many frames as
 * it takes; then they change places. So a frame never shows a mesh between two states, however scattered the changes are.
 */
export class HalfBuffers {
  readonly attribute: BufferAttribute;
  readonly #indices: Uint32Array;
  readonly #half: number;
  /** Pages in which the hidden half is older than the drawn one. */
  readonly #stale: Uint8Array;
  /** Pages of the hidden half that the GPU does not have yet, from page `#next` on. */
  readonly #dirty: Uint8Array;
  #next = 0;
  #front = 0;
  #sweeping = false;

  constructor(capacity: number) {
    this.#half = capacity;
    this.#indices = new Uint32Array(2 * capacity);
    this.#stale = new Uint8Array(Math.ceil(capacity / PAGE));
    this.#dirty = new Uint8Array(this.#stale.length);
    this.attribute = new BufferAttribute(this.#indices, 1).setUsage(DynamicDrawUsage);
  }

  /** Where the drawn half begins. */
  get start(): number {
    return this.#front * this.#half;
  }

  get sweeping(): boolean {
    return this.#sweeping;
  }

  /** Sets the first state from a place on, before anything is drawn. */
  initialise(indices: ArrayLike<number>, offset: number): void {
    this.#indices.set(indices, offset);
    this.#indices.set(indices, this.#half + offset);
  }

  /** Brings the hidden half up to the drawn one and begins to change it. */
  begin(): void {
    const [front, back] = [this.start, this.#half - this.start];
    this.#stale.forEach((stale, page) => {
      if (stale === 0) return;
      const first = page * PAGE;
      const last = Math.min(first + PAGE, this.#half);
      this.#indices.copyWithin(back + first, front + first, front + last);
    });
    this.#dirty.set(this.#stale);
    this.#stale.fill(0);
    this.#next = 0;
    this.#sweeping = true;
  }

  /** Writes indices at a place of the hidden half, between begin() and the end of the sweep. */
  write(offset: number, values: Uint32Array): void {
    if (values.length === 0) return;
    this.#indices.set(values, this.#half - this.start + offset);
    const first = Math.floor(offset / PAGE);
    const end = Math.floor((offset + values.length - 1) / PAGE) + 1;
    this.#stale.fill(1, first, end);
    this.#dirty.fill(1, first, end);
  }

  /** Hands pages over. True when the last one went and the halves have changed places. */
  advance(budget: UploadBudget): boolean {
    const back = this.#half - this.start;
    for (; this.#next < this.#dirty.length; this.#next++) {
      if (this.#dirty[this.#next] === 0) continue;
      const first = this.#next * PAGE;
      const count = Math.min(PAGE, this.#half - first);
      if (!budget.take(4 * count)) return false;
      this.attribute.addUpdateRange(back + first, count);
      this.attribute.needsUpdate = true;
    }
    this.#dirty.fill(0);
    this.#front = 1 - this.#front;
    this.#sweeping = false;
    return true;
  }
}

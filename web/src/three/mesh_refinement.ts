// SPDX-License-Identifier: Apache-2.0
import { Box3, BufferAttribute, BufferGeometry, Sphere, type TypedArray } from 'three';
import { type AttributeLayout, type DrawEvent, INDICES, type MeshEvent, type RangeEvent } from '../core/protocol.js';
import { HalfBuffers } from './half_buffers.js';
import type { Refinement } from './refinement.js';
import type { UploadBudget } from './upload_budget.js';

const ATTRIBUTE_NAMES = {
  position: 'position',
  normal: 'normal',
  texcoord_0: 'uv',
  texcoord_1: 'uv1',
  color: 'color',
} as const;

const COMPONENT_ARRAYS = {
  i8: Int8Array,
  u8: Uint8Array,
  i16: Int16Array,
  u16: Uint16Array,
  f32: Float32Array,
} as const;

/** Elements [begin, end) of an attribute's array that have arrived and that the GPU does not have yet. */
interface Fresh {
  attribute: BufferAttribute;
  begin: number;
  end: number;
}

/** A step multiplies the number of faces by this at most. */
const GROWTH = 2;

/** What leads to the mesh's next state: vertices, ranges of indices and, once the batch is whole, the number of faces. */
interface Batch {
  fresh: Fresh[];
  ranges: RangeEvent[];
  faces: number | null;
}

/**
 * A mesh that grows in place, step by step. Its geometry has buffers of the final sizes; a step hands over new vertices, then
 * the faces that use them, and only then does the geometry draw these. A step at most doubles the faces, however much has come:
 * so the picture grows finer all the time.
 */
export class MeshRefinement implements Refinement {
  readonly geometry = new BufferGeometry();
  readonly #attributes: BufferAttribute[];
  readonly #index: HalfBuffers;
  #batches: Batch[] = [];
  /** The batches of the present step. */
  #step: Batch[] = [];
  #faces = 0;
  #consumed = 0;

  /** `base` is what is drawn until the stream says otherwise; its bounds are replaced by those of the final mesh. */
  constructor(layout: MeshEvent, base: BufferGeometry, bounds: Box3) {
    this.#attributes = layout.attributes.map((attribute) => allocate(attribute, layout.vertices));
    layout.attributes.forEach(({ semantic }, i) => {
      const name = ATTRIBUTE_NAMES[semantic];
      this.geometry.setAttribute(name, this.#attributes[i]!);
      const source = base.getAttribute(name);
      if (source !== undefined) copyElements(source as BufferAttribute, this.#attributes[i]!);
    });
    this.#index = new HalfBuffers(3 * layout.faces);
    const baseIndices = base.index?.array ?? Uint32Array.from({ length: base.getAttribute('position').count }, (_, i) => i);
    this.#index.initialise(baseIndices);
    this.geometry.setIndex(this.#index.attribute);
    // Creating a buffer hands over everything, but three.js leaves the ranges standing.
    for (const attribute of [...this.#attributes, this.#index.attribute])
      attribute.onUpload(() => attribute.clearUpdateRanges());
    this.#faces = baseIndices.length / 3;
    this.geometry.setDrawRange(0, baseIndices.length);
    this.geometry.boundingBox = bounds.clone();
    this.geometry.boundingSphere = bounds.getBoundingSphere(new Sphere());
  }

  get pending(): boolean {
    const [next] = this.#batches;
    const waiting = next !== undefined && (next.faces !== null || next.fresh.length > 0);
    return this.#step.length > 0 || this.#index.sweeping || waiting;
  }

  receive(event: RangeEvent | DrawEvent): void {
    if (event.type === 'draw') this.#openBatch().faces = event.faces;
    else if (event.buffer === INDICES) this.#receiveIndices(event);
    else this.#receiveVertices(event);
  }

  /**
   * Batches that come during a step wait, so that the next sweep, which costs the same for few new faces as for many, has many.
   * Between steps the vertices of a batch go ahead of its end: the sender may wait for them to be consumed before it sends that.
   */
  advance(budget: UploadBudget): boolean {
    if (!this.#index.sweeping) {
      if (this.#step.length === 0) this.#beginStep();
      const whole = this.#step.length > 0;
      if (!this.#advanceVertices(whole ? this.#step : this.#batches, budget) || !whole) return false;
      if (!this.#beginSweep()) return true;
    }
    if (!this.#index.advance(budget)) return false;
    this.geometry.setDrawRange(this.#index.start, 3 * this.#faces);
    return true;
  }

  takeConsumed(): number {
    const bytes = this.#consumed;
    this.#consumed = 0;
    return bytes;
  }

  /** three.js hands the whole buffers over anew. */
  restart(): void {}

  dispose(): void {
    this.geometry.dispose();
  }

  #receiveVertices(event: RangeEvent): void {
    const attribute = this.#attributes[event.buffer]!;
    const { buffer, byteOffset, BYTES_PER_ELEMENT } = attribute.array;
    new Uint8Array(buffer, byteOffset).set(event.data, event.offset);
    const begin = event.offset / BYTES_PER_ELEMENT;
    this.#openBatch().fresh.push({ attribute, begin, end: begin + event.data.length / BYTES_PER_ELEMENT });
  }

  /** Indices count as consumed at once, so that any batch can arrive whole; vertices keep the sender from running ahead. */
  #receiveIndices(event: RangeEvent): void {
    this.#consumed += event.data.length;
    this.#openBatch().ranges.push(event);
  }

  /** How many batches are whole and do not lead beyond so many faces; the first one may. */
  #wholeBatches(mostFaces: number): number {
    let count = 0;
    for (const { faces } of this.#batches) {
      if (faces === null || (count > 0 && faces > mostFaces)) break;
      count++;
    }
    return count;
  }

  #openBatch(): Batch {
    const last = this.#batches.at(-1);
    if (last !== undefined && last.faces === null) return last;
    const batch: Batch = { fresh: [], ranges: [], faces: null };
    this.#batches.push(batch);
    return batch;
  }

  #beginStep(): void {
    this.#step = this.#batches.splice(0, this.#wholeBatches(GROWTH * this.#faces));
  }

  /** Hands vertices over; true when all have gone. */
  #advanceVertices(batches: Batch[], budget: UploadBudget): boolean {
    for (const { fresh } of batches) {
      for (let next = fresh[0]; next !== undefined; next = fresh[0]) {
        const size = next.attribute.array.BYTES_PER_ELEMENT;
        const count = Math.min(next.end - next.begin, Math.floor(budget.left / size));
        if (count === 0 || !budget.take(count * size)) return false;
        next.attribute.addUpdateRange(next.begin, count);
        next.attribute.needsUpdate = true;
        this.#consumed += count * size;
        next.begin += count;
        if (next.begin === next.end) fresh.shift();
      }
    }
    return true;
  }

  /** Puts the step's faces into the hidden half of the indices; false when it brings nothing but normals. */
  #beginSweep(): boolean {
    const step = this.#step.splice(0);
    if (step.every(({ ranges, faces }) => ranges.length === 0 && faces === this.#faces)) return false;
    this.#index.begin();
    for (const { ranges, faces } of step) {
      this.#faces = faces!;
      for (const { offset, data } of ranges)
        this.#index.write(offset / 4, new Uint32Array(data.buffer, data.byteOffset, data.length / 4));
    }
    return true;
  }
}

function allocate(layout: AttributeLayout, vertices: number): BufferAttribute {
  const ArrayType = COMPONENT_ARRAYS[layout.component];
  const itemSize = layout.stride / ArrayType.BYTES_PER_ELEMENT;
  return new BufferAttribute(new ArrayType(vertices * itemSize) as TypedArray, itemSize, layout.normalized);
}

/** Copies as many elements as both have, whatever the types of their numbers. */
function copyElements(from: BufferAttribute, to: BufferAttribute): void {
  const count = Math.min(from.count, to.count);
  const components = Math.min(from.itemSize, to.itemSize);
  for (let i = 0; i < count; i++) for (let c = 0; c < components; c++) to.setComponent(i, c, from.getComponent(i, c));
}

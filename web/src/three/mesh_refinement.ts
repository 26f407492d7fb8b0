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

/** Bytes of one attribute that came and that the GPU does not have yet: elements [begin, end) of its array. */
interface Fresh {
  attribute: BufferAttribute;
  begin: number;
  end: number;
}

/** The way to the mesh's next state: index ranges and, once it is whole, the number of faces. */
interface Batch {
  ranges: RangeEvent[];
  faces: number | null;
}

/**
 * A mesh that grows in place. Its geometry has buffers of the final sizes; new vertices are handed over as they come, then
 * the faces that use them, and only then does the geometry draw these.
 */
export class MeshRefinement implements Refinement {
  readonly geometry = new BufferGeometry();
  readonly #attributes: BufferAttribute[];
  readonly #index: HalfBuffers;
  readonly #finalFaces: number;
  #fresh: Fresh[] = [];
  #batches: Batch[] = [];
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
    this.#finalFaces = layout.faces;
    this.#index = new HalfBuffers(3 * layout.faces);
    const baseIndices = base.index?.array ?? Uint32Array.from({ length: base.getAttribute('position').count }, (_, i) => i);
    this.#index.initialise(baseIndices);
    this.geometry.setIndex(this.#index.attribute);
    // Creating a buffer hands over everything, but three.js leaves the ranges standing.
    for (const attribute of [...this.#attributes, this.#index.attribute])
      attribute.onUpload(() => attribute.clearUpdateRanges());
    this.geometry.setDrawRange(0, baseIndices.length);
    this.geometry.boundingBox = bounds.clone();
    this.geometry.boundingSphere = bounds.getBoundingSphere(new Sphere());
  }

  get pending(): boolean {
    return this.#fresh.length > 0 || this.#index.sweeping || this.#wholeBatch;
  }

  /** Whether the final mesh is drawn. */
  get complete(): boolean {
    return this.geometry.drawRange.count === 3 * this.#finalFaces && !this.pending;
  }

  receive(event: RangeEvent | DrawEvent): void {
    if (event.type === 'draw') this.#openBatch().faces = event.faces;
    else if (event.buffer === INDICES) this.#receiveIndices(event);
    else this.#receiveVertices(event);
  }

  /**
   * A sweep over the indices, once begun, goes first: it ends in a finer picture. Vertices that come meanwhile wait, so that
   * the next sweep, which costs the same for few new faces as for many, has many.
   */
  advance(budget: UploadBudget): boolean {
    if (!this.#index.sweeping) {
      this.#advanceVertices(budget);
      if (this.#fresh.length > 0 || !this.#beginSweep()) return false;
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
    this.#fresh.push({ attribute, begin, end: begin + event.data.length / BYTES_PER_ELEMENT });
  }

  /** Consumed as they come, so that a batch of any size comes whole; vertices keep the sender from running ahead. */
  #receiveIndices(event: RangeEvent): void {
    this.#consumed += event.data.length;
    this.#openBatch().ranges.push(event);
  }

  get #wholeBatch(): boolean {
    return this.#batches.length > 0 && this.#batches[0]!.faces !== null;
  }

  #openBatch(): Batch {
    const last = this.#batches.at(-1);
    if (last !== undefined && last.faces === null) return last;
    const batch: Batch = { ranges: [], faces: null };
    this.#batches.push(batch);
    return batch;
  }

  #advanceVertices(budget: UploadBudget): void {
    while (this.#fresh.length > 0) {
      const { attribute, begin, end } = this.#fresh[0]!;
      const size = attribute.array.BYTES_PER_ELEMENT;
      const count = Math.min(end - begin, Math.floor(budget.left / size));
      if (count === 0 || !budget.take(count * size)) return;
      attribute.addUpdateRange(begin, count);
      attribute.needsUpdate = true;
      this.#consumed += count * size;
      if (begin + count === end) this.#fresh.shift();
      else this.#fresh[0]!.begin += count;
    }
  }

  /** Puts all whole batches into the hidden half of the indices. */
  #beginSweep(): boolean {
    if (!this.#wholeBatch) return false;
    this.#index.begin();
    for (let batch = this.#batches[0]; batch !== undefined && batch.faces !== null; batch = this.#batches[0]) {
      this.#faces = batch.faces;
      for (const { offset, data } of batch.ranges)
        this.#index.write(offset / 4, new Uint32Array(data.buffer, data.byteOffset, data.length / 4));
      this.#batches.shift();
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

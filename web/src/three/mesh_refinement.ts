// SPDX-License-Identifier: Apache-2.0
import { Box3, BufferAttribute, BufferGeometry, Sphere, type TypedArray, Vector3 } from 'three';
import { type AttributeLayout, type DrawEvent, INDICES, type MeshEvent, type RangeEvent } from '../core/protocol.js';
import type { ProgressiveMeshExtension } from './extensions.js';
import { HalfBuffers } from './half_buffers.js';
import type { ProgressivePrimitive } from './opening.js';
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

/** What leads to the mesh's next state: vertices, ranges of indices and, once the batch is whole, the faces of each region. */
interface Batch {
  fresh: Fresh[];
  ranges: RangeEvent[];
  faces: number[] | null;
}

/**
 * A mesh that grows in place, step by step. Its buffers have their final sizes, and each region has a geometry that draws its part of the
 * indices; a step hands over new vertices, then the faces that use them, and only then do the geometries draw these. A step at most doubles
 * the faces, however much has come: so the picture grows finer all the time.
 */
export class MeshRefinement implements Refinement {
  readonly geometries: BufferGeometry[];
  readonly #attributes: BufferAttribute[];
  readonly #index: HalfBuffers;
  #batches: Batch[] = [];
  /** The batches of the present step. */
  #step: Batch[] = [];
  /** Of each region: where its indices begin, and how many faces it draws. */
  readonly #starts: number[] = [];
  #faces: number[];
  #consumed = 0;

  /** The regions' `base` is what is drawn until the stream says otherwise; its bounds are replaced by those of the final mesh. */
  constructor(layout: MeshEvent, regions: ProgressivePrimitive[]) {
    const { base } = regions[0]!;
    this.#attributes = layout.attributes.map((attribute) => allocate(attribute, layout.vertices));
    const names = layout.attributes.map(({ semantic }) => ATTRIBUTE_NAMES[semantic]);
    names.forEach((name, i) => {
      const source = base.getAttribute(name);
      if (source !== undefined) copyElements(source as BufferAttribute, this.#attributes[i]!);
    });
    this.#index = new HalfBuffers(3 * layout.faces);
    // Creating a buffer hands over everything, but three.js leaves the ranges standing.
    for (const attribute of [...this.#attributes, this.#index.attribute])
      attribute.onUpload(() => attribute.clearUpdateRanges());
    let start = 0;
    this.geometries = regions.map((region) => {
      const geometry = new BufferGeometry().setIndex(this.#index.attribute);
      names.forEach((name, i) => geometry.setAttribute(name, this.#attributes[i]!));
      this.#index.initialise(region.base.index!.array, start);
      this.#starts.push(start);
      start += 3 * region.extension.faces;
      const bounds = boundsOf(region.extension);
      if (regions.length === 1 && base.boundingBox) bounds.union(base.boundingBox);
      geometry.boundingBox = bounds;
      geometry.boundingSphere = bounds.getBoundingSphere(new Sphere());
      return geometry;
    });
    this.#faces = regions.map((region) => region.base.index!.count / 3);
    this.#draw();
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
    this.#draw();
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
    for (const geometry of this.geometries) geometry.dispose();
  }

  #draw(): void {
    this.geometries.forEach((geometry, i) => geometry.setDrawRange(this.#index.start + this.#starts[i]!, 3 * this.#faces[i]!));
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
      if (faces === null || (count > 0 && sum(faces) > mostFaces)) break;
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
    this.#step = this.#batches.splice(0, this.#wholeBatches(GROWTH * sum(this.#faces)));
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
    if (step.every(({ ranges, faces }) => ranges.length === 0 && sum(faces!) === sum(this.#faces))) return false;
    this.#index.begin();
    for (const { ranges, faces } of step) {
      this.#faces = faces!;
      for (const { offset, data } of ranges)
        this.#index.write(offset / 4, new Uint32Array(data.buffer, data.byteOffset, data.length / 4));
    }
    return true;
  }
}

/** The box of a primitive at its finest. */
export function boundsOf({ bounds: { min, max } }: ProgressiveMeshExtension): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max));
}

const sum = (numbers: number[]) => numbers.reduce((total, value) => total + value);

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

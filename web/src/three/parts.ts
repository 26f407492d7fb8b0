// SPDX-License-Identifier: Apache-2.0
import type { Box3, BufferGeometry, Intersection, Mesh } from 'three';
import type { PartsEvent } from '../core/protocol.js';
import type { PartsDescription } from './extensions.js';
import type { Opening } from './opening.js';

/** What a glTF says of a node or a mesh. */
export interface Said {
  name?: string;
  extras?: unknown;
}

/** A part of a pack's file that the pack shows in one mesh with others. */
export interface Part {
  node: Said;
  mesh: Said;
  /** In the space of the hit mesh. */
  bounds: Box3;
}

/** The stream's JSON, as far as it is used here. */
interface PartsFile {
  nodes: (Said & { mesh?: number })[];
  meshes: Said[];
  shown: [node: number, mesh: number][];
  merged: { nodes: number[]; table: number[] }[];
}

/** A primitive of the merged mesh. */
interface Merged {
  geometry: BufferGeometry;
  partOfFace: Uint32Array;
}

/**
 * The parts that were merged into the pack's last mesh. Their names come behind all else. Fetched for packs that have such only: it imports
 * nothing that others have (docs/decisions/008-size-of-the-page.md).
 */
export class Parts {
  readonly #merged = new Map<number, Merged>();
  readonly #description: PartsDescription;
  readonly #opening: Opening;
  readonly #Box: typeof Box3;
  #file: PartsFile | null = null;

  constructor(description: PartsDescription, opening: Opening, Box: typeof Box3) {
    this.#description = description;
    this.#opening = opening;
    this.#Box = Box;
  }

  async receive({ file, inflated }: PartsEvent): Promise<void> {
    const stream = new Blob([file]).stream().pipeThrough(new DecompressionStream('gzip'));
    const bytes = new Uint8Array(inflated);
    let length = 0;
    for (const reader = stream.getReader(); ; ) {
      const { value, done } = await reader.read();
      if (done) break;
      if (length + value.length > inflated) return console.warn('Lightwell: what tells of the parts is larger than the pack states');
      bytes.set(value, length);
      length += value.length;
    }
    this.#file = JSON.parse(new TextDecoder().decode(bytes)) as PartsFile;
  }

  /**
   * The part that a ray has hit. Undefined where the mesh is no merged one: then its own name and `userData` are the file's; and until all
   * of it has come.
   */
  at({ object, faceIndex }: Intersection): Part | undefined {
    const mesh = object as Mesh;
    const at = this.#opening.gltf.parser.associations.get(mesh) as { meshes?: number; primitives?: number } | undefined;
    const said = this.#file?.merged[at?.primitives ?? 0];
    if (at?.meshes !== this.#description.meshes || said === undefined || faceIndex == null) return undefined;
    const merged = this.#mergedOf(at.primitives ?? 0, mesh.geometry, said.table);
    const part = merged?.partOfFace[faceIndex - mesh.geometry.drawRange.start / 3];
    return part === undefined ? undefined : { ...this.#saidOf(said.nodes[part]!), bounds: this.#boundsOf(merged!, part) };
  }

  #saidOf(node: number): { node: Said; mesh: Said } {
    const { nodes, meshes, shown } = this.#file!;
    const own = node < this.#description.nodes;
    const mesh = own ? shown.find(([owner]) => owner === node)?.[1] : nodes[node - this.#description.nodes]?.mesh;
    const json = this.#opening.gltf.parser.json as { nodes: Said[] };
    return {
      node: (own ? json.nodes[node] : nodes[node - this.#description.nodes]) ?? {},
      mesh: meshes[(mesh ?? 0) - this.#description.meshes] ?? {},
    };
  }

  #mergedOf(primitive: number, geometry: BufferGeometry, table: number[]): Merged | undefined {
    const known = this.#merged.get(primitive);
    if (known?.geometry === geometry) return known;
    for (const { extension, meshes } of [...this.#opening.primitives.values()].flat())
      if (meshes[0]!.geometry === geometry && geometry.drawRange.count < 3 * extension.faces) return undefined;
    const merged = { geometry, partOfFace: partsOfFaces(geometry, table) };
    this.#merged.set(primitive, merged);
    return merged;
  }

  #boundsOf({ geometry, partOfFace }: Merged, part: number): Box3 {
    const box = new this.#Box();
    const index = geometry.index!;
    const { start } = geometry.drawRange;
    const point = box.min.clone();
    for (let face = 0; face < partOfFace.length; face++)
      if (partOfFace[face] === part)
        for (let corner = 0; corner < 3; corner++)
          box.expandByPoint(point.fromBufferAttribute(geometry.getAttribute('position'), index.getX(start + 3 * face + corner)));
    return box;
  }
}

/** The part of each face that is drawn by the table of docs/format.md: a number for each piece of faces that vertices join. */
export function partsOfFaces(geometry: BufferGeometry, table: number[]): Uint32Array {
  const { start, count } = geometry.drawRange;
  const corners = geometry.index!.array.slice(start, start + count);
  const joined = joinedVertices(corners, geometry.getAttribute('position').count);
  const pieces = [...new Set(corners.map((vertex) => joined[vertex]!))].sort((a, b) => a - b);
  const number = new Map(pieces.map((vertex, piece) => [vertex, piece]));
  const pieceOf = (corner: number) => number.get(joined[corners[corner]!]!)!;
  const place = placesOf(geometry, Uint32Array.from(new Set(corners)));
  const firstAt = new Map<number, number>();
  for (let corner = 0; corner < corners.length; corner++) {
    const at = place[corners[corner]!]!;
    firstAt.set(at, Math.min(firstAt.get(at) ?? Infinity, pieceOf(corner)));
  }
  const touching = pieces.map((_, piece) => piece);
  for (let corner = 0; corner < corners.length; corner++) {
    const piece = pieceOf(corner);
    touching[piece] = Math.min(touching[piece]!, firstAt.get(place[corners[corner]!]!)!);
  }
  const parts: number[] = [];
  for (let piece = 0; piece < pieces.length; piece++) parts.push(table[piece] ? table[piece]! - 1 : parts[touching[piece]!]!);
  return Uint32Array.from({ length: corners.length / 3 }, (_, face) => parts[pieceOf(3 * face)]!);
}

/** For each vertex, the least one that faces join it to. */
function joinedVertices(corners: ArrayLike<number>, count: number): Uint32Array {
  const parent = Uint32Array.from({ length: count }, (_, vertex) => vertex);
  const root = (vertex: number) => {
    while (parent[vertex] !== vertex) vertex = parent[vertex] = parent[parent[vertex]!]!;
    return vertex;
  };
  for (let i = 0; i < corners.length; i++) {
    const [a, b] = [root(corners[i - (i % 3)]!), root(corners[i]!)];
    parent[Math.max(a, b)] = Math.min(a, b);
  }
  return parent.map((_, vertex) => root(vertex));
}

/** For each of some vertices, one that stands for all of them at the same position. */
function placesOf(geometry: BufferGeometry, order: Uint32Array): Uint32Array {
  const position = geometry.getAttribute('position');
  const compare = (a: number, b: number) =>
    position.getX(a) - position.getX(b) || position.getY(a) - position.getY(b) || position.getZ(a) - position.getZ(b);
  order.sort(compare);
  const place = new Uint32Array(position.count);
  order.forEach((vertex, i) => (place[vertex] = i > 0 && compare(order[i - 1]!, vertex) === 0 ? place[order[i - 1]!]! : vertex));
  return place;
}

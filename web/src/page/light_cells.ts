// SPDX-License-Identifier: Apache-2.0
//
// Shows how a grid divides space: the edges of its bricks, and its nodes as little stones lit by the grid itself. Nodes that lookups
// leave out, since they stand in solids or on sheets, are red, and so are links between neighbours that a wall blocks.
import type { BufferAttribute, BufferGeometry, Mesh, MeshStandardMaterial } from 'three';
import { halfValues } from '../three/half.js';
import type { LightwellLight } from '../three/light.js';
import type { LightwellScene } from '../three/scene.js';

/** What the page has of three.js, so that this script need not bring it. */
export interface Three {
  BufferAttribute: typeof BufferAttribute;
  BufferGeometry: typeof BufferGeometry;
  Mesh: typeof Mesh;
  MeshStandardMaterial: typeof MeshStandardMaterial;
}

type Place = [number, number, number];

/** Of a brick, on each axis. */
const CELLS = 4;
/** Of a cell. */
const STONE = 0.06;
/** Below this share of a valid node's weight a node is left out: lightwell/light/grid.h. */
const LEFT_OUT = 2 ** -6;
/** Of bricks, from coarse to fine. */
const COLORS = [0x5b6b7b, 0x2f9e6e, 0x2f7fd6, 0xd9812b, 0xc23fb0];
const RED = 0xff2020;
/** Beside what lamps light. */
const BRIGHT = 2;
const OCTAHEDRON = [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];

/** The edges of each grid's bricks, or the box of a regular grid. Add to the pack. */
export function brickEdges(pack: LightwellScene, three: Three): Mesh[] {
  return pack.grids.flatMap((grid) => {
    const cells = new Cells(grid);
    const ofLevels = COLORS.map(() => [] as Place[][]);
    for (const { level, first, last } of cells.bricks()) ofLevels[level]!.push([first, last].map((place) => cells.position(place)));
    return ofLevels.flatMap((boxes, level) => (boxes.length > 0 ? edgesOf(boxes, COLORS[level]!, three) : []));
  });
}

/** Blocked links, red lines between nodes; `ends` as LightwellScene.withBlockedLinks gives them. */
export function linkLines(ends: Float32Array, three: Three): Mesh[] {
  const lines: number[] = [];
  for (let first = 0; first < ends.length / 3; first += 2) lines.push(first, first + 1, first + 1);
  const up = Array.from(ends, (_, i) => Number(i % 3 === 1));
  return ends.length > 0 ? [edges([...ends], up, lines, RED, three)] : [];
}

/** The nodes of each grid. Add to the pack. */
export function gridNodes(pack: LightwellScene, three: Three): Mesh[] {
  return pack.grids.flatMap((grid) => {
    const cells = new Cells(grid);
    const [valid, leftOut] = [[] as [Place, Place][], [] as [Place, Place][]];
    for (const { place, level, weight } of cells.nodes())
      (weight > LEFT_OUT * cells.largestWeight ? valid : leftOut).push([cells.position(place), cells.stone(level)]);
    return [stones(valid, 0, three), stones(leftOut, RED, three)];
  });
}

/** Reads the atlas of a grid: lightwell/light/atlas.h. Places are counted in cells of the finest level. */
class Cells {
  readonly #values = halfValues();
  readonly #atlas: Uint16Array;
  readonly #width: number;
  readonly #height: number;
  readonly #finest: number;
  readonly #subVolume: number;
  readonly #first: number;
  readonly #cells: Place;
  readonly #definition: LightwellLight['definition'];
  readonly largestWeight: number;

  constructor({ texture, definition }: LightwellLight) {
    const { width, height, depth } = texture.image;
    this.#definition = definition;
    this.#atlas = texture.image.data as Uint16Array;
    this.#width = width;
    this.#height = height;
    const [, finest, subVolume, first] = this.#texel([1, 0, 0]);
    this.#finest = finest!;
    this.#subVolume = finest === 0 ? depth / 7 : subVolume!;
    this.#first = finest === 0 ? 1 : first!;
    this.#cells = definition.nodes.map((nodes) => (nodes - 1) * 2 ** finest!) as Place;
    this.largestWeight = 0;
    for (const { weight } of this.nodes()) this.largestWeight = Math.max(this.largestWeight, weight);
  }

  position(place: Place): Place {
    const { min, cell } = this.#definition;
    return place.map((at, axis) => min[axis]! + (cell[axis]! * at) / 2 ** this.#finest) as Place;
  }

  /** Half the size of a node's stone. */
  stone(level: number): Place {
    return this.#definition.cell.map((side) => (STONE * side) / 2 ** level) as Place;
  }

  *bricks(): Generator<{ level: number; first: Place; last: Place }> {
    if (this.#finest === 0) return void (yield { level: 0, first: [0, 0, 0], last: this.#cells });
    const seen = new Set<string>();
    for (const { brick, level, at } of this.#cubes()) {
      if (seen.has(String(brick))) continue;
      seen.add(String(brick));
      const side = CELLS * 2 ** (this.#finest - level);
      const first = at.map((x) => side * Math.floor((x * CELLS) / side)) as Place;
      yield { level, first, last: first.map((x, axis) => Math.min(x + side, this.#cells[axis]!)) as Place };
    }
  }

  /** Each node that some lookup reads, once, at the finest level that has it. */
  *nodes(): Generator<{ place: Place; level: number; weight: number }> {
    if (this.#finest === 0) {
      for (const place of box([0, 0, 0], this.#cells, 1)) yield { place, level: 0, weight: this.#weight(place) };
      return;
    }
    const seen = new Set<string>();
    for (const { brick, level, at } of this.#cubes()) {
      const step = 2 ** (this.#finest - level);
      const low = at.map((x) => Math.ceil((x * CELLS) / step) * step) as Place;
      const high = at.map((x, axis) => Math.min((x + 1) * CELLS, this.#cells[axis]!)) as Place;
      for (const place of box(low, high, step)) {
        if (seen.has(String(place))) continue;
        seen.add(String(place));
        const within = place.map((x, axis) => x / step - CELLS * Math.floor((at[axis]! * CELLS) / (CELLS * step)));
        yield { place, level, weight: this.#weight(within.map((x, axis) => brick[axis]! + x) as Place) };
      }
    }
  }

  /** The cubes of the indirection: the first texel of the brick in each, and its level. */
  *#cubes(): Generator<{ at: Place; brick: Place; level: number }> {
    const count = this.#cells.map((cells) => Math.ceil(cells / CELLS)) as Place;
    for (const at of box([0, 0, 0], count.map((n) => n - 1) as Place, 1)) {
      const [x, y, z, level] = this.#texel([at[0], at[1], at[2] + 1]);
      yield { at, brick: [x!, y!, z!], level: level! };
    }
  }

  #weight([x, y, z]: Place): number {
    return this.#texel([x, y, z + this.#first + 6 * this.#subVolume])[3]!;
  }

  #texel([x, y, z]: Place): number[] {
    const at = 4 * (x + this.#width * (y + this.#height * z));
    return [0, 1, 2, 3].map((lane) => this.#values[this.#atlas[at + lane]!]!);
  }
}

/** The places from `low` to `high`, both included. */
function* box(low: Place, high: Place, step: number): Generator<Place> {
  for (let z = low[2]; z <= high[2]; z += step)
    for (let y = low[1]; y <= high[1]; y += step) for (let x = low[0]; x <= high[0]; x += step) yield [x, y, z];
}

/** The edges of boxes, as triangles without area of which only edges are drawn. */
function edgesOf(boxes: Place[][], color: number, three: Three): Mesh {
  const positions: number[] = [];
  const indices: number[] = [];
  for (const corners of boxes) {
    const first = positions.length / 3;
    for (let corner = 0; corner < 8; corner++) {
      positions.push(...[0, 1, 2].map((axis) => corners[(corner >> axis) & 1]![axis]!));
      for (const axis of [1, 2, 4]) if ((corner & axis) === 0) indices.push(first + corner, first + (corner | axis), first + (corner | axis));
    }
  }
  const up = positions.map((_, i) => Number(i % 3 === 1));
  return edges(positions, up, indices, color, three);
}

function edges(positions: number[], normals: number[], indices: number[], color: number, three: Three): Mesh {
  const mesh = meshOf(positions, normals, indices, color, three);
  mesh.material.wireframe = true;
  return mesh;
}

function stones(nodes: [Place, Place][], color: number, three: Three): Mesh {
  const positions: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (const [place, size] of nodes) {
    indices.push(...OCTAHEDRON.map((corner) => positions.length / 3 + corner));
    for (const axis of [0, 1, 2])
      for (const sign of [1, -1]) {
        positions.push(...place.map((x, i) => x + (i === axis ? sign * size[i]! : 0)));
        normals.push(...[0, 1, 2].map((i) => (i === axis ? sign : 0)));
      }
  }
  return meshOf(positions, normals, indices, color, three);
}

/** White, or of a color that shines by itself. */
function meshOf(positions: number[], normals: number[], indices: number[], color: number, three: Three) {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new three.BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(new three.BufferAttribute(new Uint32Array(indices), 1));
  const material = new three.MeshStandardMaterial({ color: color === 0 ? 0xffffff : 0, emissive: color, emissiveIntensity: BRIGHT });
  return new three.Mesh(geometry, material);
}

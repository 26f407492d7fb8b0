// SPDX-License-Identifier: Apache-2.0
import type { DataTexture, Matrix4, Vector3 } from 'three';
import { halfValues } from '../half.js';
import type { Opening } from '../opening.js';
import { three } from './kit.js';

/** Of the table of radiance that directions are drawn from. */
const COLUMNS = 64;
const ROWS = 32;
const LUMINANCE = [0.2126, 0.7152, 0.0722] as const;

type Triple = [number, number, number];

/** A cell of the sky: the direction of its middle, its radiance, and its solid angle. */
interface Cell {
  readonly direction: Vector3;
  readonly radiance: Triple;
  readonly solidAngle: number;
}

/**
 * What surrounds a pack's scene, as a lamp: directions by their radiance, and the irradiance of whom nothing hides it from. In the pack's
 * space. A picture is taken as it is when this is made.
 */
export class Sky {
  /** Of each colour: the irradiance of a surface with the normal n is n M n, n being (x, y, z, 1). */
  readonly irradiance: [Matrix4, Matrix4, Matrix4];
  readonly #cells: Cell[][];
  /** Running sums of luminance: of the rows, and of the cells of each row; none where the sky is the same everywhere. */
  readonly #rows: Float64Array | null;
  readonly #columns: Float64Array[];

  private constructor(cells: Cell[][], uniform: boolean) {
    this.#cells = cells;
    this.irradiance = [0, 1, 2].map((channel) => irradianceOf(cells.flat(), channel)) as [Matrix4, Matrix4, Matrix4];
    this.#columns = cells.map((row) => runningSums(row.map((cell) => cell.solidAngle * luminanceOf(cell))));
    this.#rows = uniform ? null : runningSums(this.#columns.map((row) => row.at(-1)!));
  }

  /** Whether a pack tells of its sky: one may have the light of a picture that it does not hold. */
  static isKnown(opening: Opening, picture: DataTexture | undefined): boolean {
    return picture !== undefined || notedRadiance(opening) !== null;
  }

  /** `picture`: of the surroundings, half floats as three.js has them. Without one the sky is as the scene notes it: the same everywhere. */
  static of(opening: Opening, picture: DataTexture | undefined): Sky {
    if (picture !== undefined) return new Sky(cellsOf(picture), false);
    const radiance = notedRadiance(opening) ?? [0, 0, 0];
    return new Sky(cellsFrom(() => radiance), true);
  }

  /**
   * The direction of a point of the unit square, and the colour of the light from there, of luminance 1: where more light comes from there are
   * more of them, evenly spread.
   */
  sampleOf(a: number, b: number): { direction: Vector3; color: Triple } {
    if (this.#rows === null) return { direction: direction(b, Math.acos(1 - 2 * a) / Math.PI), color: [1, 1, 1] };
    const row = find(this.#rows, a);
    const y = Math.floor(row);
    const column = find(this.#columns[y]!, b);
    const cell = this.#cells[y]![Math.floor(column)]!;
    // A picture that is black all over gives nothing, and no NaN.
    const luminance = luminanceOf(cell) || 1;
    const color = cell.radiance.map((channel) => channel / luminance) as Triple;
    const [below, above] = heightsOf(y);
    return { direction: direction(column / COLUMNS, Math.acos(below + (row - y) * (above - below)) / Math.PI), color };
  }
}

/** The radiance that the scene says its sky has everywhere (extras.lightwell.skyRadiance), if it does. */
function notedRadiance({ gltf }: Opening): Triple | null {
  const noted: unknown = gltf.scene.userData['lightwell']?.skyRadiance;
  return Array.isArray(noted) && noted.length === 3 && noted.every(Number.isFinite) ? (noted as Triple) : null;
}

/** The heights of a row's lower and upper edge on a sphere of radius 1. */
function heightsOf(row: number): [number, number] {
  return [-Math.cos((Math.PI * row) / ROWS), -Math.cos((Math.PI * (row + 1)) / ROWS)];
}

/** `u` around from -x over -z, `v` from up to down, as parts of all. */
function direction(u: number, v: number): Vector3 {
  const [around, down] = [2 * Math.PI * (u - 0.5), Math.PI * v];
  return new three.Vector3(Math.sin(down) * Math.cos(around), Math.cos(down), Math.sin(down) * Math.sin(around));
}

function luminanceOf({ radiance }: Cell): number {
  return radiance.reduce((sum, channel, c) => sum + LUMINANCE[c]! * channel, 0);
}

/** Rows from below, as a texture has them. */
function cellsFrom(radianceOf: (column: number, row: number) => Triple): Cell[][] {
  return Array.from({ length: ROWS }, (_, row) => {
    const [below, above] = heightsOf(row);
    const solidAngle = ((2 * Math.PI) / COLUMNS) * (above - below);
    return Array.from({ length: COLUMNS }, (_, column) => ({
      direction: direction((column + 0.5) / COLUMNS, Math.acos((below + above) / 2) / Math.PI),
      radiance: radianceOf(column, row),
      solidAngle,
    }));
  });
}

/** Means of the picture's pixels, or those again and again. */
function cellsOf({ image }: DataTexture): Cell[][] {
  const { width, height } = image;
  const texels = image.data as Uint16Array;
  const halves = halfValues();
  return cellsFrom((column, row) => {
    const sum: Triple = [0, 0, 0];
    const [x0, y0] = [Math.floor((column * width) / COLUMNS), Math.floor((row * height) / ROWS)];
    const x1 = Math.max(x0 + 1, Math.floor(((column + 1) * width) / COLUMNS));
    const y1 = Math.max(y0 + 1, Math.floor(((row + 1) * height) / ROWS));
    for (let y = y0; y < y1; y++)
      for (let x = x0; x < x1; x++) for (let c = 0; c < 3; c++) sum[c]! += halves[texels[4 * (y * width + x) + c]!]!;
    return sum.map((channel) => channel / ((x1 - x0) * (y1 - y0))) as Triple;
  });
}

/**
 * The irradiance by the first nine spherical harmonics, in moments of the radiance: a quarter of its sum, half of its first moments along
 * the normal, and 5/32 of three times its second ones less the sum (R. Ramamoorthi, P. Hanrahan, An Efficient Representation for
 * Irradiance Environment Maps, 2001).
 */
function irradianceOf(cells: Cell[], channel: number): Matrix4 {
  const moments = Array.from({ length: 4 }, () => [0, 0, 0, 0]);
  for (const { direction, radiance, solidAngle } of cells) {
    const along = [...direction.toArray(), 1];
    const light = radiance[channel]! * solidAngle;
    along.forEach((a, i) => along.forEach((b, j) => (moments[i]![j]! += light * a * b)));
  }
  const weight = (i: number, j: number) => (i < 3 && j < 3 ? 15 / 32 : i === j ? 3 / 32 : 1 / 4);
  const matrix = new three.Matrix4();
  return matrix.fromArray(moments.flatMap((row, i) => row.map((moment, j) => weight(i, j) * moment)));
}

function runningSums(values: number[]): Float64Array {
  let sum = 0;
  return Float64Array.from(values, (value) => (sum += value));
}

/** Where a part of the last sum is reached, between 0 and the number of sums. */
function find(sums: Float64Array, part: number): number {
  const wanted = part * sums.at(-1)!;
  const at = sums.findIndex((sum) => sum > wanted);
  if (at < 0) return sums.length - 0.5;
  const before = sums[at - 1] ?? 0;
  return at + (wanted - before) / (sums[at]! - before);
}

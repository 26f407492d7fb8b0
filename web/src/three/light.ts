// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  Data3DTexture,
  HalfFloatType,
  Light,
  LinearFilter,
  Matrix4,
  Quaternion,
  RGBAFormat,
  Vector3,
} from 'three';
import type { LightGridDefinition } from './extensions.js';
import { installLightChunks } from './shader_chunks.js';

/** 0 to 7 as half floats. */
const HALVES = [0, 0x3c00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600, 0x4700];

/** How the light between nodes is found: `tricubic` has no creases on the borders of cells, takes eight times the fetches, and leaks more. */
export type LightLookup = 'trilinear' | 'tricubic';

/**
 * A baked light grid, in the form of three.js's light probe grids: it lights every standard material of its scene, those of
 * the user's own objects too. It stands where its parent stands, however that is moved, turned or scaled. The place of the
 * nodes is told to the shader as shaders/light_grid.glsl describes.
 */
export class LightwellLight extends Light {
  override readonly type = 'LightwellLight';
  readonly isLightProbeGrid = true;
  /** The texels of lightwell/light/atlas.h as they are newest; another one with every finer state. */
  newest: Data3DTexture;
  /** The grid whose texels are shown in the place of these, or this one. */
  shown: LightwellLight = this;
  /** Not a box: `min` is the world position of the first node, `max` the vector part of the grid's rotation. */
  readonly boundingBox = new Box3();
  /** Not counts: the size of the grid in the world, z negated as the mark of Lightwell's grids. */
  readonly resolution = new Vector3();
  /** Where grids overlap the one of higher priority is taken. */
  priority: number;
  readonly #corner: Matrix4;
  readonly #size: Vector3;

  /** `atlas`: the texels of lightwell/light/atlas.h. LightRefinement brings finer ones. */
  constructor(
    readonly definition: LightGridDefinition,
    atlas: LightAtlas,
    readonly lookup: LightLookup = 'trilinear',
  ) {
    super();
    installLightChunks();
    const { min, cell, nodes } = definition;
    this.priority = definition.priority ?? 0;
    this.#corner = new Matrix4().makeTranslation(...min);
    this.#size = new Vector3(...nodes).subScalar(1).multiply(new Vector3(...cell));
    this.newest = atlasTexture(atlas, this);
  }

  /** What three.js shows. */
  get texture(): Data3DTexture {
    return this.shown.newest;
  }

  override updateMatrixWorld(force?: boolean): void {
    super.updateMatrixWorld(force);
    const rotation = new Quaternion();
    new Matrix4().multiplyMatrices(this.matrixWorld, this.#corner).decompose(this.boundingBox.min, rotation, this.resolution);
    if (rotation.w < 0) rotation.set(-rotation.x, -rotation.y, -rotation.z, -rotation.w);
    this.boundingBox.max.set(rotation.x, rotation.y, rotation.z);
    this.resolution.multiply(this.#size);
    this.resolution.z *= -1;
  }

  override dispose(): void {
    this.newest.dispose();
  }
}

/** The texels of a grid, half floats. */
export interface LightAtlas {
  readonly atlas: Uint16Array<ArrayBuffer>;
  readonly width: number;
  readonly height: number;
  readonly depth: number;
}

/**
 * A filtered texture of a grid's texels, with marks in the second one, which no lookup filters: whether the grid holds the light
 * of the environment (1); the shader then leaves out the diffuse part of `scene.environment`; whether lookups are tricubic (2); and whether
 * the sky shines beside it as a lamp (4).
 * Throws when their number is wrong.
 */
export function atlasTexture(
  { atlas, width, height, depth }: LightAtlas,
  { definition, lookup }: Pick<LightwellLight, 'definition' | 'lookup'>,
): Data3DTexture {
  if (atlas.length !== 4 * width * height * depth)
    throw new Error(`the light of stream ${definition.stream} has another size than its texture`);
  const environment = definition.contains?.includes('environment') === true;
  atlas[4] = HALVES[(environment ? 1 : 0) + (lookup === 'tricubic' ? 2 : 0) + (definition.insteadOf ? 4 : 0)]!;
  const texture = new Data3DTexture(atlas, width, height, depth);
  texture.format = RGBAFormat;
  texture.type = HalfFloatType;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

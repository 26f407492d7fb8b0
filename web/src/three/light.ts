// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  Data3DTexture,
  DataUtils,
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

/** Seven RGBA texels hold the nine RGB coefficients of a node and its weight. */
const SUB_VOLUMES = 7;
const HALF_ONE = 0x3c00;

/**
 * A baked light grid, in the form of three.js's light probe grids: it lights every standard material of its scene, those of
 * the user's own objects too. It stands where its parent stands, however that is moved, turned or scaled. The place of the
 * nodes is told to the shader as shaders/light_grid.glsl describes.
 */
export class LightwellLight extends Light {
  override readonly type = 'LightwellLight';
  readonly isLightProbeGrid = true;
  /** The texels of lightwell/light/atlas.h that are shown; another one with every finer state. */
  texture: Data3DTexture;
  /** Not a box: `min` is the world position of the first node, `max` the vector part of the grid's rotation. */
  readonly boundingBox = new Box3();
  /** Not counts: the size of the grid in the world, z negated as the mark of Lightwell's grids. */
  readonly resolution = new Vector3();
  /** Where grids overlap the one of higher priority is taken. */
  priority: number;
  readonly #corner: Matrix4;
  readonly #size: Vector3;

  /** A dark grid. Its light comes through LightRefinement or, at once, through `setAtlas`. */
  constructor(readonly definition: LightGridDefinition) {
    super();
    installLightChunks();
    const { min, cell, nodes } = definition;
    this.priority = definition.priority ?? 0;
    this.#corner = new Matrix4().makeTranslation(...min);
    this.#size = new Vector3(...nodes).subScalar(1).multiply(new Vector3(...cell));
    this.texture = atlasTexture(darkAtlas(definition), definition);
  }

  /** Replaces the whole light in one frame: the texels of lightwell/light/atlas.h in their patched form. */
  setAtlas(atlas: Uint16Array<ArrayBuffer>): void {
    this.texture.image.data = markContents(atlas, this.definition);
    this.texture.needsUpdate = true;
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
    this.texture.dispose();
  }
}

/** A filtered texture of a grid's texels. */
export function atlasTexture(atlas: Uint16Array<ArrayBuffer>, { nodes }: LightGridDefinition): Data3DTexture {
  const texture = new Data3DTexture(atlas, nodes[0], nodes[1], SUB_VOLUMES * (nodes[2] + 2));
  texture.format = RGBAFormat;
  texture.type = HalfFloatType;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/**
 * Writes into the second texel, which no lookup filters, whether the grid holds the light of the environment; the shader then
 * leaves out the diffuse part of `scene.environment`.
 */
export function markContents(atlas: Uint16Array<ArrayBuffer>, definition: LightGridDefinition): Uint16Array<ArrayBuffer> {
  atlas[4] = definition.contains?.includes('environment') === true ? HALF_ONE : 0;
  return atlas;
}

/** No light anywhere, at full weight; the header texel as lightwell/light/atlas.h describes it. */
function darkAtlas(definition: LightGridDefinition): Uint16Array<ArrayBuffer> {
  const { cell, nodes, normalOffset } = definition;
  const texels = nodes[0] * nodes[1] * SUB_VOLUMES * (nodes[2] + 2);
  const atlas = new Uint16Array(4 * texels);
  for (let texel = (texels / SUB_VOLUMES) * (SUB_VOLUMES - 1); texel < texels; texel++) atlas[4 * texel + 3] = HALF_ONE;
  const longest = Math.max(...cell);
  [...cell.map((side) => side / longest), normalOffset].forEach((value, i) => (atlas[i] = DataUtils.toHalfFloat(value)));
  return markContents(atlas, definition);
}

// SPDX-License-Identifier: Apache-2.0
import { Box3, type Camera, Frustum, Matrix4, type Mesh, type SkinnedMesh, Vector3 } from 'three';
import { assetOf, type LightGridDefinition } from './extensions.js';
import type { LightwellLight } from './light.js';
import type { Opening, ProgressiveImage, ProgressivePrimitive } from './opening.js';

/** Weight of what is out of sight, relative to the same in sight: it comes late, not never. */
const OUT_OF_SIGHT = 0.01;
/** Number of places on each axis at which a box is tested for being in sight. */
const PLACES = 5;

type Bounds = Pick<NonNullable<LightGridDefinition['bricks']>[number], 'min' | 'max'>;

export type AssetWeight = [asset: number, weight: number];

/**
 * How much the assets matter to a picture: of a mesh its coarsest level's error, of an image the size of its preview's texels,
 * both in pixels and times the share of the picture that the object covers, the largest being 1; of a light grid, and of those of its finer
 * cells that have a stream of their own, the share of their box that is seen.
 */
export function viewWeights(
  opening: Pick<Opening, 'primitives' | 'images'>,
  grids: LightwellLight[],
  camera: Camera,
  heightInPixels: number,
): AssetWeight[] {
  const view = new View(camera, heightInPixels);
  const geometry = [...opening.primitives, ...opening.images].map(([asset, shown]): AssetWeight => [
    asset,
    Math.max(0, ...[shown].flat().flatMap(({ meshes }) => meshes).map((mesh) => view.of(mesh, [shown].flat()[0]!))),
  ]);
  const largest = Math.max(Number.MIN_VALUE, ...geometry.map(([, weight]) => weight));
  return [
    ...geometry.map(([asset, weight]): AssetWeight => [asset, weight / largest]),
    ...grids.flatMap(({ definition, matrixWorld }) => [
      [assetOf(definition), view.ofBox(boxOfGrid(definition), matrixWorld)] as AssetWeight,
      ...(definition.bricks ?? []).map((bricks): AssetWeight => [assetOf(bricks), view.ofBox(bricks, matrixWorld)]),
    ]),
  ];
}

class View {
  readonly #frustum: Frustum;
  readonly #eye: Vector3;
  /** Half the picture's heights that a metre takes at a metre's distance. */
  readonly #focal: number;

  constructor(
    camera: Camera,
    readonly heightInPixels: number,
  ) {
    camera.updateMatrixWorld();
    const toClip = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.#frustum = new Frustum().setFromProjectionMatrix(toClip);
    this.#eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
    this.#focal = camera.projectionMatrix.elements[5]!;
  }

  /** Of an image as if it went once over its mesh. */
  of(mesh: Mesh, shown: ProgressivePrimitive | ProgressiveImage): number {
    if ('base' in shown) return this.#errorOf(mesh, shown.extension.error * mesh.matrixWorld.getMaxScaleOnAxis());
    return this.#errorOf(mesh, boxOf(mesh).getSize(new Vector3()).length() / shown.previewSize);
  }

  ofBox({ min, max }: Bounds, toWorld: Matrix4): number {
    let seen = 0;
    for (let i = 0; i < PLACES ** 3; i++) {
      const place = [i, i / PLACES, i / PLACES ** 2].map((step, axis) => {
        const share = (Math.floor(step) % PLACES) / (PLACES - 1);
        return min[axis]! + share * (max[axis]! - min[axis]!);
      });
      if (this.#frustum.containsPoint(new Vector3(...place).applyMatrix4(toWorld))) seen++;
    }
    return Math.max(OUT_OF_SIGHT, seen / PLACES ** 3);
  }

  /** An error in metres, in pixels times the object's share of the picture. */
  #errorOf(mesh: Mesh, metres: number): number {
    const box = boxOf(mesh);
    const diagonal = box.getSize(new Vector3()).length();
    const distance = Math.max(box.distanceToPoint(this.#eye), 0.05 * diagonal, 1e-6);
    const share = Math.min(1, (this.#focal * diagonal) / distance / 2) ** 2;
    const pixels = (metres * this.#focal * this.heightInPixels) / 2 / distance;
    return pixels * share * (this.#frustum.intersectsBox(box) ? 1 : OUT_OF_SIGHT);
  }
}

const boxOfGrid = ({ min, cell, nodes }: LightGridDefinition): Bounds => ({
  min,
  max: min.map((lo, axis) => lo + (nodes[axis]! - 1) * cell[axis]!) as Bounds['max'],
});

/** The bounds of a mesh in the world. */
function boxOf(mesh: Mesh): Box3 {
  if (mesh.geometry.boundingBox === null) mesh.geometry.computeBoundingBox();
  const { boundingBox } = mesh as Mesh | SkinnedMesh as Partial<SkinnedMesh>;
  return new Box3().copy(boundingBox ?? mesh.geometry.boundingBox!).applyMatrix4(mesh.matrixWorld);
}

// SPDX-License-Identifier: Apache-2.0
import { Box3, type Camera, Frustum, Matrix4, Vector3 } from 'three';
import type { ProgressivePrimitive } from './opening.js';

/**
 * How much the streams of meshes matter to a picture: an error of a metre in pixels, times the share of the picture's height
 * that the object takes, squared; the mean is 1, which is also the weight of light. What is out of sight comes late, not never.
 */
export function meshWeights(
  primitives: Map<number, ProgressivePrimitive>,
  camera: Camera,
  heightInPixels: number,
): [stream: number, weight: number][] {
  camera.updateMatrixWorld();
  const frustum = new Frustum().setFromProjectionMatrix(
    new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
  );
  const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const focal = camera.projectionMatrix.elements[5]!;
  const raw = [...primitives].map(([stream, { extension, meshes }]): [number, number] => {
    const box = new Box3(new Vector3(...extension.bounds.min), new Vector3(...extension.bounds.max));
    let weight = 0;
    for (const mesh of meshes) {
      const world = box.clone().applyMatrix4(mesh.matrixWorld);
      const diagonal = world.getSize(new Vector3()).length();
      const distance = Math.max(world.distanceToPoint(eye), 0.05 * diagonal, 1e-6);
      const share = Math.min(1, (focal * diagonal) / distance / 2);
      const seen = frustum.intersectsBox(world) ? 1 : 0.01;
      weight = Math.max(weight, ((seen * focal * heightInPixels) / 2 / distance) * share * share);
    }
    return [stream, weight];
  });
  const mean = raw.reduce((sum, [, weight]) => sum + weight, 0) / Math.max(raw.length, 1);
  return raw.map(([stream, weight]) => [stream, weight / Math.max(mean, 1e-12)]);
}

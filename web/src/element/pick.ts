// SPDX-License-Identifier: Apache-2.0
import type { Intersection, Object3D, Raycaster, Vector3 } from 'three';
import type { LightwellScene } from '../three/scene.js';
import type { LightwellView } from './lightwell_view.js';

/** The nearest surface of a pack along a ray: of the triangles that have come and are drawn. */
export function nearestHit(pack: LightwellScene, origin: Vector3, direction: Vector3, far = Infinity): Intersection | undefined {
  const hits: Intersection[] = [];
  // All that a mesh asks a ray caster for; three.js's own would have to be imported.
  const caster = { ray: { origin, direction }, near: 0, far } as Raycaster;
  pack.traverseVisible((object: Object3D) => 'isMesh' in object && object.raycast(caster, hits));
  return hits.sort((a, b) => a.distance - b.distance)[0];
}

/** What an element's pack shows at a place of the browser's window. */
export function pick(view: LightwellView, { clientX, clientY }: MouseEvent): Intersection | undefined {
  const { pack, camera } = view;
  if (pack === null) return undefined;
  const { left, top, width, height } = view.getBoundingClientRect();
  camera.updateMatrixWorld();
  const origin = camera.position.clone();
  const direction = camera.position.clone().set((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height, 0.5);
  return nearestHit(pack, origin, direction.unproject(camera).sub(origin).normalize());
}

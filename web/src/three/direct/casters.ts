// SPDX-License-Identifier: Apache-2.0
import type { Box3, Mesh, Object3D, Vector3 } from 'three';
import type { LampDefinition } from '../extensions.js';
import type { Opening } from '../opening.js';
import { three } from './kit.js';

/** Of the surfaces that stand for lamps, and of bulbs right round them, none stops its light, as in the bake. */
export function letLampsThrough(definitions: LampDefinition[], opening: Opening, focus: Box3): void {
  for (const { node, primitive } of definitions)
    if (node !== undefined && primitive !== undefined)
      for (const mesh of opening.meshesOf(node, primitive)) mesh.castShadow = false;
  for (const { center, kind } of definitions)
    if (center !== undefined && (kind === 'point' || kind === 'spot'))
      opening.gltf.scene.traverse((object) => {
        if (isBulb(object, new three.Vector3(...center), focus)) object.castShadow = false;
      });
}

/** Whether a mesh stands right round a lamp and is small. */
function isBulb(object: Object3D, lamp: Vector3, focus: Box3): boolean {
  if (!(object as Mesh).isMesh) return false;
  const box = new three.Box3().setFromObject(object);
  const longest = (of: Box3) => Math.max(...of.getSize(new three.Vector3()).toArray());
  return box.containsPoint(lamp) && longest(box) <= longest(focus) / 8;
}

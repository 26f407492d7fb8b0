// SPDX-License-Identifier: Apache-2.0
import type { InstancedMesh, Object3D, SkinnedMesh } from 'three';
import { mapsOf, materialsOf } from './meshes.js';

/** Frees what the GPU holds of an object and of all below it: meshes, lines and points, their materials and textures. */
export function disposeAll(root: Object3D): void {
  root.traverse((object) => {
    const shown = object as Partial<SkinnedMesh> & Partial<InstancedMesh>;
    shown.geometry?.dispose();
    shown.skeleton?.dispose();
    shown.dispose?.();
    for (const material of materialsOf(shown)) {
      for (const texture of mapsOf(material)) texture.dispose();
      material.dispose();
    }
  });
}

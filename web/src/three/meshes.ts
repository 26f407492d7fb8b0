// SPDX-License-Identifier: Apache-2.0
import { type Material, Mesh, type Object3D, type Texture } from 'three';

/** The meshes among an object and all below it. */
export function meshesIn(root: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  root.traverse((object) => object instanceof Mesh && meshes.push(object));
  return meshes;
}

/** None of what has none. */
export function materialsOf({ material }: Partial<Mesh>): Material[] {
  return [material ?? []].flat();
}

/** The textures that a material has, one for each use. */
export function mapsOf(material: Material): Texture[] {
  return Object.values(material).filter((value: Texture | null) => value?.isTexture);
}

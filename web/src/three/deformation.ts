// SPDX-License-Identifier: Apache-2.0
import type { BufferAttribute, BufferGeometry, Mesh, SkinnedMesh } from 'three';
import type { GLTF } from 'three/addons/loaders/GLTFLoader.js';
import type { ProgressivePrimitive } from './opening.js';

/** glTF's semantics by three.js's names. */
const SKIN = { skinIndex: 'JOINTS_0', skinWeight: 'WEIGHTS_0' };
const DISPLACEMENTS = { position: 'POSITION', normal: 'NORMAL' };

/** A finer skin reaches beyond the coarse one's bounds by less than this share of them. */
const MARGIN = 0.1;

/**
 * Gives primitives that a skin or morph targets bend what bends the vertices of their final level, which come later, and skinned meshes
 * bounds in their pose while all their vertices are there.
 */
export async function prepareDeformation(primitives: Iterable<ProgressivePrimitive>, { parser, scene }: GLTF): Promise<void> {
  const read = (accessor: number) => parser.getDependency('accessor', accessor) as Promise<BufferAttribute>;
  scene.updateMatrixWorld(true);
  for (const primitive of primitives) {
    const { extension, base, meshes } = primitive;
    if (extension.deformation === undefined) continue;
    primitive.bend = (to) => handOver(base, to);
    const { attributes, targets } = extension.deformation;
    for (const mesh of meshes.filter(isSkinned)) boundInPose(mesh);
    for (const [name, semantic] of Object.entries(SKIN))
      if (attributes[semantic] !== undefined) base.setAttribute(name, await read(attributes[semantic]));
    for (const [name, semantic] of Object.entries(DISPLACEMENTS) as ['position' | 'normal', string][])
      if (base.morphAttributes[name] !== undefined)
        base.morphAttributes[name] = await Promise.all(targets.map((target) => read(target[semantic]!)));
    for (const mesh of meshes.filter(isSkinned)) mesh.normalizeSkinWeights();
  }
}

function handOver(from: BufferGeometry, to: BufferGeometry): void {
  for (const name of Object.keys(SKIN)) {
    if (!from.hasAttribute(name)) continue;
    to.setAttribute(name, from.getAttribute(name));
    from.deleteAttribute(name);
  }
  to.morphAttributes = from.morphAttributes;
  to.morphTargetsRelative = from.morphTargetsRelative;
}

const isSkinned = (mesh: Mesh): mesh is SkinnedMesh => 'isSkinnedMesh' in mesh;

function boundInPose(mesh: SkinnedMesh): void {
  mesh.computeBoundingBox();
  mesh.computeBoundingSphere();
  const { boundingBox, boundingSphere } = mesh;
  boundingBox!.expandByScalar(MARGIN * boundingSphere!.radius);
  boundingSphere!.radius *= 1 + MARGIN;
}

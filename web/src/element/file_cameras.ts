// SPDX-License-Identifier: Apache-2.0
import type { Camera } from 'three';
import type { LightwellScene } from '../three/scene.js';

/** As the file has it: three.js changes names. */
const nameOf = ({ name, userData }: Camera): string => userData['name'] ?? name;

/** The names of a pack's cameras, in the file's order. */
export function cameraNames(pack: LightwellScene | null): string[] {
  return pack?.opening.gltf.cameras.map(nameOf) ?? [];
}

/** A pack's camera of a name. Throws when it has none. */
export function cameraNamed(pack: LightwellScene | null, name: string): Camera {
  const camera = pack?.opening.gltf.cameras.find((camera) => nameOf(camera) === name);
  if (camera === undefined) throw new Error(`lightwell-view: no camera “${name}”`);
  return camera;
}

// SPDX-License-Identifier: Apache-2.0
//
// three.js's own ProgressiveLightMap, one light a frame, in its best setting: no gloss, no dithering, the newest of its two maps, and a
// window of as many frames as there were: with its default of 100 it goes on to flicker.
import * as THREE from 'three';
import { ProgressiveLightMap } from 'three/addons/misc/ProgressiveLightMap.js';
import { JitteredLamp, sharesOf } from './jittered.js';
import { pixelsOf, renderer, stage } from './stage.js';

const SIZE = 1024;

/** Shares after each number of frames. */
export function progressiveLightMap(definition, counts, kind) {
  const { scene, floor, meshes, camera } = stage(definition);
  const lamp = new JitteredLamp(definition.lamp, kind, 1);
  const map = new ProgressiveLightMap(renderer, SIZE);
  map.uvMat.specular.setScalar(0);
  map.progressiveLightMap1.texture.channel = 1;
  // Other materials than Basic have the light itself besides.
  floor.material = new THREE.MeshBasicMaterial();
  map.addObjectsToLightMap([floor, ...lamp.lights]);
  floor.material.dithering = false;
  // What nobody looks at casts its shadow, and takes no room in the map.
  const others = meshes.filter((mesh) => mesh !== floor);
  for (const mesh of others) mesh.material = new THREE.MeshBasicMaterial({ colorWrite: false, depthWrite: false, side: THREE.DoubleSide });
  map.scene.add(...others);
  const shares = new Map();
  for (let frame = 1; frame <= Math.max(...counts); frame++) {
    lamp.jitter();
    const newest = map.buffer1Active ? map.progressiveLightMap1 : map.progressiveLightMap2;
    map.update(camera, frame);
    if (!counts.includes(frame)) continue;
    floor.material.lightMap = newest.texture;
    shares.set(frame, sharesOf(pixelsOf(scene, camera)));
  }
  map.dispose();
  return counts.map((count) => shares.get(count));
}

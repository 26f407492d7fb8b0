// SPDX-License-Identifier: Apache-2.0
//
// Lightwell's direct light of the same scene, without a pack.
import { Box3, Group } from 'three';
import { DirectLight } from '../../web/src/three/direct/direct_light.js';
import { DIRECT_KIT } from '../../web/src/three/direct_kit.js';
import { FrameScheduler } from '../../web/src/three/frame_scheduler.js';
import { pixelsOf, renderer, stage } from './stage.js';

/** Of the GPU's time in a frame, milliseconds: samples come as fast as they can. */
const ALL_TIME = 10_000;

/** Lamps over a scene; `changes` counts how often there is a better picture. */
export function light(definitions, scene) {
  const bounds = new Box3().setFromObject(scene);
  const opening = { gltf: { scene: new Group() }, meshesOf: () => [] };
  const lit = { changes: 0 };
  const changed = () => void lit.changes++;
  const surroundings = { renderer, scheduler: FrameScheduler.of(renderer), bounds, focus: bounds, opening, environment: undefined, grids: [], changed };
  lit.direct = new DirectLight(DIRECT_KIT, definitions, surroundings);
  scene.add(lit.direct.hook, lit.direct.carrier, ...lit.direct.lamps);
  return lit;
}

/** Shares of the first frame, and after each number of points of the lamp, powers of two as the page shows them. */
export async function lightwell(definition, counts) {
  const { scene, camera } = stage(definition);
  const lit = light([definition.lamp], scene);
  lit.direct.setShadows('off');
  const whole = pixelsOf(scene, camera);
  const shares = () => {
    const pixels = pixelsOf(scene, camera);
    return Array.from({ length: pixels.length / 4 }, (_, i) => (whole[4 * i] > 0 ? pixels[4 * i] / whole[4 * i] : 0));
  };
  lit.direct.setShadows('soft', ALL_TIME);
  const results = [shares()];
  for (const count of counts) {
    while (lit.direct.samples < count) {
      const seen = lit.changes;
      while (lit.changes === seen) await new Promise(requestAnimationFrame);
    }
    results.push(shares());
  }
  lit.direct.dispose();
  return results;
}

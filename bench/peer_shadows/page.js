// SPDX-License-Identifier: Apache-2.0
//
// All methods on one scene, each pixel's share of the lamp.
import { accumulativeShadows } from './accumulative_shadows.js';
import { lightwell } from './lightwell.js';
import { pcss } from './pcss.js';
import { progressiveLightMap } from './progressive_light_map.js';
import { pictureOf, placesOf, stage } from './stage.js';

Object.assign(globalThis, {
  places: (definition) => placesOf(stage(definition)),
  pictureOf,
  lightwell,
  progressiveLightMap,
  accumulativeShadows,
  pcss,
});

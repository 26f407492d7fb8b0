// SPDX-License-Identifier: Apache-2.0
import { ShaderChunk } from 'three';
import lookup from '../../../shaders/light_grid.glsl';
import reflection from '../../../shaders/light_grid_reflection.glsl';

/**
 * Puts Lightwell's lookup in place of the one of three.js, once a page and before any material is compiled. Grids of three.js's own
 * look as before.
 */
export function installLightChunks(): void {
  if (ShaderChunk.lightprobes_pars_fragment === lookup) return;
  ShaderChunk.lightprobes_pars_fragment = lookup;
  ShaderChunk.lights_fragment_maps += reflection;
}

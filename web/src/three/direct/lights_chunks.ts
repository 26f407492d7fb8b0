// SPDX-License-Identifier: Apache-2.0
import lamps from '../../../../shaders/direct_light.glsl';
import gloss from '../../../../shaders/direct_light_gloss.glsl';
import loop from '../../../../shaders/direct_light_loop.glsl';
import sky from '../../../../shaders/direct_light_sky.glsl';
import { three } from './kit.js';

/** Of the spot light that stands for the lamps of a pack; no other light has it. */
export const DECAY_OF_LAMPS = -100;
const LOOKUP = /spotLightCoord = [^;]*;\s*inSpotLightMap = [^;]*;\s*spotColor = [^;]*;\s*directLight\.color = [^;]*;/;

/** What passes read lamps and their shares by, as materials do. */
export function textForPasses(): string {
  // For the number three.js would write that of the scene's lights.
  return ['precision highp float;precision highp sampler2D;', three.ShaderChunk.common, lamps.replaceAll('NUM_SPOT_LIGHT_MAPS', '1')].join('\n');
}

/**
 * Lets materials be lit by the lamps of packs, once a page. A material that was compiled before has no such spot light, and is compiled
 * anew when one comes. Throws when three.js's text is another.
 */
export function installLampChunks(): void {
  const { ShaderChunk } = three;
  if (ShaderChunk.lights_pars_begin.includes(lamps)) return;
  const replaced = ShaderChunk.lights_fragment_begin.replace(LOOKUP, (own) => `${loop}\n${own}\n}`);
  if (replaced === ShaderChunk.lights_fragment_begin) throw new Error('the shader of spot lights is not that of three.js 0.187');
  ShaderChunk.lights_fragment_begin = replaced;
  ShaderChunk.lights_pars_begin += `${lamps}\n${gloss}`;
  ShaderChunk.lights_fragment_maps += sky;
}

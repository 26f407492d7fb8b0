// SPDX-License-Identifier: Apache-2.0
import {
  type Box3,
  DirectionalLight,
  LinearSRGBColorSpace,
  PointLight,
  Sphere,
  SpotLight,
  Vector3,
} from 'three';
import type { LampDefinition } from './extensions.js';
import { installLightChunks } from './shader_chunks.js';

export type Lamp = SpotLight | PointLight | DirectionalLight;

/** Half the opening of the cone that stands for a one-sided lamp; a shadow map cannot see a whole half-space. */
const RECTANGLE_ANGLE = (85 * Math.PI) / 180;
/** Marks the lights that fade as in KHR_lights_punctual: see shaders/punctual_lamps.glsl. */
const KHRONOS_DECAY = -2;
const MOST_SHADOWS = 4;
const SHADOW_MAP_SIZE = 2048;
/** Texture units that WebGL2 guarantees a fragment shader. */
export const TEXTURE_UNITS = 16;
/** Units that a lit standard material needs besides its maps: the light grid, the table of its BRDF, an environment. */
const SHARED_UNITS = 3;

/**
 * three.js lights for a pack's lamps, in the pack's space. A rectangle becomes a spot light with a soft edge at 85 degrees,
 * a sphere a point light, each with the irradiance that the lamp has on its axis at the middle of the scene: three.js has no
 * area light with a shadow (docs/decisions/006-lamps-in-three.md). Points and spots fade as the bake has them
 * (docs/decisions/016-punctual-lamps.md). The strongest cast shadows: at most four, and no more
 * than leave `materialMaps` texture units for the materials.
 */
export function createLamps(definitions: LampDefinition[], bounds: Box3, materialMaps: number): Lamp[] {
  installLightChunks();
  const shadows = Math.max(0, Math.min(MOST_SHADOWS, TEXTURE_UNITS - SHARED_UNITS - materialMaps));
  const sphere = bounds.getBoundingSphere(new Sphere());
  const lamps = definitions.flatMap(sides).map((definition) => ({ light: createLamp(definition, sphere), group: definition.group, power: irradianceAt(definition, sphere) }));
  lamps.sort((a, b) => b.power - a.power);
  lamps.slice(0, shadows).forEach(({ light }) => castShadow(light, sphere));
  return lamps.map(({ light, group }) => Object.assign(light, { userData: { group } }));
}

/** A lamp that shines to both sides is two. */
function sides(definition: LampDefinition): LampDefinition[] {
  const { normal, twoSided } = definition;
  if (twoSided !== true || normal === undefined) return [definition];
  return [definition, { ...definition, normal: [-normal[0], -normal[1], -normal[2]] }];
}

function createLamp(definition: LampDefinition, scene: Sphere): Lamp {
  const center = new Vector3(...(definition.center ?? [0, 0, 0]));
  const normal = new Vector3(...(definition.normal ?? [0, -1, 0]));
  switch (definition.kind) {
    case 'sun': {
      const sun = new DirectionalLight();
      sun.position.copy(scene.center).addScaledVector(normal, -2 * scene.radius);
      aim(sun, scene.center);
      return colored(sun, definition.intensity);
    }
    case 'spot': {
      const { innerConeAngle: inner = 0, outerConeAngle: outer = Math.PI / 4 } = definition;
      const spot = new SpotLight(undefined, 1, definition.range ?? 0, outer, 1 - inner / outer, KHRONOS_DECAY);
      spot.position.copy(center);
      aim(spot, center.clone().add(normal));
      return colored(spot, definition.intensity);
    }
    case 'rectangle': {
      const spot = new SpotLight(undefined, 1, 0, RECTANGLE_ANGLE, 1);
      spot.position.copy(center);
      aim(spot, center.clone().add(normal));
      return colored(spot, definition.radiance, pointLikeFactor(definition, center.distanceTo(scene.center)));
    }
    case 'sphere':
    case 'point': {
      const point = new PointLight(undefined, 1, definition.range ?? 0, KHRONOS_DECAY);
      point.position.copy(center);
      return definition.kind === 'point'
        ? colored(point, definition.intensity)
        : colored(point, definition.radiance, areaOf(definition));
    }
  }
}

/** Target and light stay siblings, so that both follow the pack. */
function aim(light: SpotLight | DirectionalLight, at: Vector3): void {
  light.target.position.copy(at);
}

/** three.js multiplies a colour by an intensity; both are linear here. */
function colored(light: Lamp, rgb: [number, number, number] = [0, 0, 0], factor = 1): Lamp {
  const strongest = Math.max(...rgb, 1e-9);
  light.color.setRGB(rgb[0] / strongest, rgb[1] / strongest, rgb[2] / strongest, LinearSRGBColorSpace);
  light.intensity = strongest * factor;
  return light;
}

/** Fits lamps to a pack that has become so many times as large: each of its places keeps its light. */
export function scaleLamps(lamps: Lamp[], ratio: number): void {
  for (const light of lamps) {
    const { shadow } = light;
    if (light instanceof DirectionalLight) spread(light, ratio * light.shadow.camera.right);
    else {
      light.intensity *= ratio * ratio;
      light.distance *= ratio;
    }
    shadow.normalBias *= ratio;
    shadow.camera.near *= ratio;
    shadow.camera.far *= ratio;
    shadow.camera.updateProjectionMatrix();
  }
}

/** A sun's shadows reach so far from their middle. */
function spread({ shadow }: DirectionalLight, radius: number): void {
  Object.assign(shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius });
}

/** The area that a lamp shows to a point on its axis, in square metres. */
function areaOf({ u, v, radius = 0 }: LampDefinition): number {
  if (u === undefined || v === undefined) return Math.PI * radius * radius;
  return 4 * new Vector3(...u).cross(new Vector3(...v)).length();
}

/**
 * Radiance times this is the intensity of a point with the irradiance of a rectangle on its axis at `distance`: that of a
 * disc of the same area, pi L r2 / (r2 + d2).
 */
function pointLikeFactor(definition: LampDefinition, distance: number): number {
  const area = areaOf(definition);
  const squared = distance * distance;
  return (area * squared) / (squared + area / Math.PI);
}

/** How strong a lamp is in the middle of the scene, to choose those that cast shadows. */
function irradianceAt(definition: LampDefinition, scene: Sphere): number {
  const distance = new Vector3(...(definition.center ?? [0, 0, 0])).distanceTo(scene.center);
  const strength = Math.max(...(definition.radiance ?? definition.intensity ?? [0, 0, 0]));
  if (definition.kind === 'sun') return strength;
  const area = definition.radiance === undefined ? 1 : areaOf(definition);
  return (strength * area) / Math.max(distance * distance, 1e-6);
}

function castShadow(light: Lamp, scene: Sphere): void {
  light.castShadow = true;
  const shadow = light.shadow;
  shadow.mapSize.set(SHADOW_MAP_SIZE, SHADOW_MAP_SIZE);
  shadow.bias = -0.0005;
  shadow.normalBias = 0.004 * scene.radius;
  if (light instanceof DirectionalLight) {
    const { radius } = scene;
    spread(light, radius);
    Object.assign(light.shadow.camera, { near: radius, far: 3 * radius });
    return;
  }
  if (light instanceof PointLight) shadow.mapSize.divideScalar(4);
  shadow.camera.near = 0.005 * scene.radius;
  shadow.camera.far = light.position.distanceTo(scene.center) + scene.radius;
}

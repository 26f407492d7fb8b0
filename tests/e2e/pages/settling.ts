// SPDX-License-Identifier: Apache-2.0
//
// When lamps have samples enough: what the page says of how far off their shadows are.
import { Color, Mesh, OrthographicCamera, PlaneGeometry, RawShaderMaterial, Scene } from 'three';
import permitted from '../../../shaders/permitted_difference.glsl';
import { type Lamp } from '../../../web/src/three/direct/lamp.js';
import { Rounds, type Shadow } from '../../../web/src/three/direct/rounds.js';
import type { LampDefinition } from '../../../web/src/three/extensions.js';
import { ALL_TIME, light, rowCamera, rowOf, surface } from './direct_light.js';

const WIDTH = 128;

/** What was shown of a row of the floor, how many samples that had at least, and by how much it might be off. */
interface Shown {
  row: number[];
  samples: number;
  error: number;
}

/**
 * A lamp above a floor, behind the edge of a half-plane or with nothing in its way: all that is shown of it until it is at rest, and how many
 * samples there are then for a brighter one, and for a camera that moves.
 */
export async function shownOf(definition: LampDefinition, occluded: boolean): Promise<{ shown: Shown[]; brighter: number[]; moved: number[] }> {
  const objects = [surface(10, 10, [0, 0, 0], [0, 1, 0]), ...(occluded ? [surface(10, 10, [-5, 1, 0], [0, 1, 0])] : [])];
  const lit = light([definition], objects);
  const { direct, scene } = lit;
  const camera = rowCamera(0.48);
  direct.setShadows('soft', ALL_TIME);
  rowOf(scene, camera, WIDTH);
  const shown: Shown[] = [];
  for (let changes = lit.changes; direct.samples < Infinity; changes = lit.changes) {
    const before = direct.error;
    while (lit.changes === changes && direct.samples < Infinity) await new Promise(requestAnimationFrame);
    const samples = direct.samples;
    const row = rowOf(scene, camera, WIDTH);
    while (direct.error === before && direct.samples < Infinity) await new Promise(requestAnimationFrame);
    shown.push({ row, samples, error: direct.error });
  }
  const [lamp] = direct.lamps;
  const { intensity } = lamp!;
  const brighter = [0.1, 1.5, 100].map((factor) => {
    lamp!.intensity = factor * intensity;
    rowOf(scene, camera, WIDTH);
    return direct.samples;
  });
  lamp!.intensity = intensity;
  // By as little as roundings move a camera that rests, and by more.
  const moved = [1e-15, 1e-3].map((way) => {
    camera.position.x += way;
    rowOf(scene, camera, WIDTH);
    return direct.samples;
  });
  direct.dispose();
  return { shown, brighter, moved };
}

/** The largest steps that are not seen, of contrasts, from the shader. */
export function permittedDifferences(contrasts: number[]): number[] {
  const fragmentShader = `precision highp float;\n${permitted}\nuniform float contrast;out vec4 result;void main(){result=vec4(getPermittedDifference(contrast));}`;
  const vertexShader = 'in vec3 position;void main(){gl_Position=vec4(position,1.0);}';
  return contrasts.map((contrast) => {
    const material = new RawShaderMaterial({ glslVersion: '300 es', vertexShader, fragmentShader, uniforms: { contrast: { value: contrast } } });
    return rowOf(new Scene().add(new Mesh(new PlaneGeometry(2, 2), material)), new OrthographicCamera(), 1)[0]! / Math.PI;
  });
}

/** The order in which lamps of so many samples, so far off, get samples in the next round, by their numbers; each may have 64. */
export function roundOf(lamps: [count: number, off: number][]): number[] {
  const lamp = { color: new Color(), intensity: 1, visible: true } as Lamp;
  const shadows = lamps.map(([count, off]) => ({ lamp, count, off, strength: 1 }) as Shadow);
  const rounds = new Rounds();
  rounds.begin(shadows, () => 64);
  const order: number[] = [];
  for (let next = rounds.next(); next !== undefined; next = rounds.next()) {
    order.push(shadows.indexOf(next));
    next.count++;
  }
  return order;
}

Object.assign(globalThis, { shownOf, permittedDifferences, roundOf });

// SPDX-License-Identifier: Apache-2.0
import type { Lamp } from './lamp.js';
import type { ShadowMap } from './shadow_map.js';

/** How many points of a lamp are enough: of one with an area, and of one without, whose map alone is smoothed. */
const POINTS = 256;
const POINTS_OF_POINT = 32;
/** Of the sky: under a uniform one half of its directions come from below a floor. */
const POINTS_OF_SKY = 512;
/** A visitor who saves data saves power, too. */
const SAVING = 4;
/** From so many points of a lamp its shadow is shown. */
export const FIRST_SHOWN = 16;
/** Of a lamp that has become this much brighter, as it is shown, the shadow may be seen to be off where it was not. */
const MUCH_BRIGHTER = 2;

/** A lamp's shadow in the present view. */
export interface Shadow {
  readonly lamp: Lamp;
  /** Which of all shares are its own: of the sky one for each colour. */
  readonly shares: readonly [number, ...number[]];
  /** From the lamp's middle; kept while nothing moves but the camera, until that rests. */
  readonly middle: ShadowMap;
  middleStale: boolean;
  form: number[] | null;
  /** Points whose samples are in the sums: 0 when only the middle is, -1 when nothing is. */
  count: number;
  /** On how many points what the picture shows of it rests; 0: on its middle. */
  shown: number;
  /** By how many steps that are just not seen it may be off, at the strength that the lamp then had; Infinity: that is not known. */
  off: number;
  strength: number;
}

/** Begins anew with what is known of a shadow. */
export function begin(shadow: Shadow, count: number): void {
  Object.assign(shadow, { count, shown: 0, off: Infinity });
}

/** How many points of a lamp are as many as there will be. */
export function enoughPointsOf({ definition: { kind, radiance } }: Lamp): number {
  const saving = (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;
  const points = kind === 'sky' ? POINTS_OF_SKY : radiance !== undefined ? POINTS : POINTS_OF_POINT;
  return points / (saving ? SAVING : 1);
}

/** How bright the lamp's light is shown. */
export const strengthOf = ({ lamp: { color, intensity, visible } }: Shadow, exposure: number) =>
  Number(visible) * exposure * intensity * (0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b);

/** Whether more of `most` points would not be seen. */
export function isSettled(shadow: Shadow, most: number, exposure: number): boolean {
  return shadow.count >= most || (shadow.off <= 1 && strengthOf(shadow, exposure) <= MUCH_BRIGHTER * shadow.strength);
}

/**
 * Which lamp gets the next sample. In a round the lamps whose shadows are farthest off what they will be, as a visitor sees it, get as many
 * samples as they have: then what is shown has one half of them, and the other half tells how far off it is.
 */
export class Rounds {
  #lamps = new Map<Shadow, number>();

  /** Begins a round of those that are not settled, of which `mostOf` tells how many points there are. */
  begin(open: Shadow[], mostOf: (shadow: Shadow) => number): void {
    const young = open.filter(({ count }) => count < FIRST_SHOWN);
    const worst = Math.max(...open.map(({ off }) => off));
    const chosen = young.length > 0 ? young : open.filter(({ off }) => off >= worst / 2);
    const until = ({ count }: Shadow) => (count < FIRST_SHOWN ? FIRST_SHOWN : 2 * count);
    this.#lamps = new Map(chosen.map((shadow) => [shadow, Math.min(mostOf(shadow), until(shadow))]));
  }

  /** Something is no longer as it was when the round began. */
  forget(): void {
    this.#lamps.clear();
  }

  get lamps(): Shadow[] {
    return [...this.#lamps.keys()];
  }

  /** Of the round the one that has fewest points, unless all have theirs. */
  next(): Shadow | undefined {
    const open = [...this.#lamps].filter(([{ count }, until]) => count < until).map(([shadow]) => shadow);
    return open.sort((a, b) => a.count - b.count)[0];
  }
}

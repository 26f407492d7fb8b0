// SPDX-License-Identifier: Apache-2.0
import type { View } from './orbit.js';

/** The attributes of <lightwell-view> with what they may say; web/README.md explains each. */
export interface LightwellViewAttributes {
  src?: string;
  poster?: string;
  loading?: 'auto' | 'eager' | 'lazy';
  'camera-controls'?: boolean | '' | 'always' | 'walk';
  'camera-orbit'?: string;
  'camera-target'?: string;
  'field-of-view'?: string;
  exposure?: number | string;
  'environment-background'?: 'sharp' | 'blurred' | 'none';
  light?: 'all' | 'off' | 'direct' | 'indirect';
  'light-lookup'?: 'trilinear' | 'tricubic';
  shadows?: 'soft' | 'hard' | 'off';
  tone?: 'neutral' | 'none';
  strategy?: 'interleave' | 'geometry' | 'light';
  wireframe?: boolean | '';
  'auto-rotate'?: boolean | '';
  animation?: boolean | string;
  compare?: boolean | number | string;
  measure?: boolean | '';
  'raking-light'?: boolean | string;
  'any-three'?: boolean | '';
  'max-image-megapixels'?: number | string;
}

/** The attributes that change the picture. */
export const DRAWN_ATTRIBUTES = [
  'camera-controls',
  'camera-orbit',
  'camera-target',
  'field-of-view',
  'exposure',
  'environment-background',
  'light',
  'shadows',
  'tone',
  'strategy',
  'wireframe',
  'aria-label',
  'auto-rotate',
  'animation',
  'compare',
  'measure',
  'raking-light',
];
export const LIGHTS = ['all', 'off', 'direct', 'indirect'] as const;
export const LOOKUPS = ['trilinear', 'tricubic'] as const;
export const SHADOWS = ['soft', 'hard', 'off'] as const;
export const STRATEGIES = ['interleave', 'geometry', 'light'] as const;
export const TONES = ['neutral', 'none'] as const;

const UNITS: Record<string, number> = { '': 1, deg: Math.PI / 180, rad: 1, m: 1, cm: 0.01, mm: 0.001 };

/** A number with one of the units, or without one: "30deg", "1.5m", "0.5rad". Angles in radians. Null if it is none. */
export function parseQuantity(text: string): number | null {
  const match = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(deg|rad|cm|mm|m)?$/i.exec(text.trim());
  if (match === null) return null;
  return Number(match[1]) * UNITS[(match[2] ?? '').toLowerCase()]!;
}

/** Three quantities between spaces; null if there are not three. */
function parseTriple(text: string | null): [number, number, number] | null {
  const parts = text?.trim().split(/\s+/).map(parseQuantity) ?? [];
  return parts.length === 3 && parts.every((part) => part !== null) ? (parts as [number, number, number]) : null;
}

/** The view that the camera's two attributes say, the rest as it is now; null when they say nothing. */
export function parseView(orbit: string | null, target: string | null, now: View): View | null {
  const [theta = now.theta, phi = now.phi, radius = now.radius] = parseTriple(orbit) ?? [];
  const place = parseTriple(target);
  if (place === null && parseTriple(orbit) === null) return null;
  return { theta, phi, radius, target: place ?? now.target };
}

/** One of the words, the first of them for anything else. */
export function parseWord<Word extends string>(text: string | null, words: readonly [Word, ...Word[]]): Word {
  return words.find((word) => word === text) ?? words[0];
}

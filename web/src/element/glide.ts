// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from './lightwell_view.js';
import type { View } from './orbit.js';

/** Of a glide, in seconds. */
const DURATION = 0.7;
const FULL_TURN = 2 * Math.PI;

/** What ends the glide in each element. */
const glides = new WeakMap<LightwellView, AbortController>();

/**
 * Brings the camera to another view: in a while, which ends when the visitor does something, or at once where reduced motion is
 * preferred. Resolves when it is there or has ended.
 */
export function glide(view: LightwellView, to: View): Promise<void> {
  glides.get(view)?.abort();
  const { pack, view: from } = view;
  if (from === null || matchMedia('(prefers-reduced-motion: reduce)').matches) {
    view.view = to;
    return Promise.resolve();
  }
  const end = new AbortController();
  glides.set(view, end);
  for (const act of ['pointerdown', 'wheel', 'keydown']) view.addEventListener(act, () => end.abort(), { signal: end.signal, passive: true });
  const began = performance.now();
  return new Promise((resolve) => {
    const step = () => {
      if (end.signal.aborted || view.pack !== pack) return resolve();
      const part = Math.min(1, (performance.now() - began) / 1000 / DURATION);
      view.view = between(from, to, part * part * (3 - 2 * part));
      if (part === 1) end.abort();
      requestAnimationFrame(step);
    };
    step();
  });
}

/** Part of the way from a view to another, round by the shorter side. */
function between(from: View, to: View, part: number): View {
  if (part === 1) return to;
  const mix = (a: number, b: number) => a + (b - a) * part;
  const turn = to.theta - from.theta;
  return {
    theta: from.theta + part * (turn - FULL_TURN * Math.round(turn / FULL_TURN)),
    phi: mix(from.phi, to.phi),
    radius: from.radius * (to.radius / from.radius) ** part,
    target: from.target.map((place, axis) => mix(place, to.target[axis]!)) as View['target'],
  };
}

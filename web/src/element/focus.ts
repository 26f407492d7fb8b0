// SPDX-License-Identifier: Apache-2.0
import { glide } from './glide.js';
import type { LightwellView } from './lightwell_view.js';
import { pick } from './pick.js';

/** The camera comes so much nearer to what was clicked. */
const NEARER = 0.5;
/** But not nearer than this part of the pack's size. */
const NEAREST = 1 / 100;

/** A double click, or double tap: the camera turns around the point that was hit, and comes nearer. Beside the pack it returns. */
export function focus(view: LightwellView, event: MouseEvent): void {
  const controls = view.getAttribute('camera-controls');
  if (controls === null || controls === 'walk' || view.hasAttribute('measure')) return;
  const hit = pick(view, event);
  if (hit === undefined) return view.reset();
  const { min, max } = view.pack!.focus;
  const radius = Math.max(NEARER * hit.distance, Math.min(hit.distance, NEAREST * min.distanceTo(max)));
  void glide(view, { ...view.view!, radius, target: hit.point.toArray() });
}

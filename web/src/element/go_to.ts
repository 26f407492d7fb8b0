// SPDX-License-Identifier: Apache-2.0
//
// Places that have names: hotspots and the cameras of the file.
import type { Kit } from './extras.js';
import { glide } from './glide.js';
import type { LightwellView } from './lightwell_view.js';
import type { View } from './orbit.js';

/** Brings the camera to a view, to that of a hotspot or to a camera of the file. Rejects when there is none of the name. */
export async function goTo(view: LightwellView, place: View | string, kit: Kit): Promise<void> {
  if (typeof place !== 'string') return glide(view, place);
  const hotspot = view.querySelector<HTMLElement>(`[slot='hotspot-${CSS.escape(place)}']`);
  return glide(view, (hotspot && viewOf(view, hotspot, kit)) ?? viewOfCamera(view, place));
}

/** Where a hotspot has the camera go, if anywhere: to its `data-camera`, or its `data-orbit` and `data-target`. */
export function viewOf(view: LightwellView, { dataset }: HTMLElement, kit: Kit): View | null {
  const { camera, orbit, target } = dataset as Record<string, string | undefined>;
  if (camera !== undefined) return viewOfCamera(view, camera);
  return view.view && kit.parseView(orbit ?? null, target ?? null, view.view);
}

/** Looks through the file's camera and back, between two frames: nobody sees it. */
function viewOfCamera(view: LightwellView, name: string): View {
  const before = view.view;
  view.lookThrough(name);
  const there = view.view!;
  view.view = before!;
  return there;
}

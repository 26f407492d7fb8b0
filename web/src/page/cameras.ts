// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** Offers the cameras of a pack that has several. */
export function bindCameras(view: LightwellView): void {
  const select = document.querySelector<HTMLSelectElement>('#cameras')!;
  const list = () => {
    select.replaceChildren(...view.cameraNames.map((name) => new Option(name)));
    select.parentElement!.hidden = view.cameraNames.length < 2;
  };
  select.addEventListener('change', () => view.lookThrough(select.value));
  view.on('load', list);
  list();
}

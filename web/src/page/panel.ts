// SPDX-License-Identifier: Apache-2.0
import { BufferAttribute, BufferGeometry, Mesh, MeshStandardMaterial } from 'three';
import type { LightwellView } from '../element/lightwell_view.js';

/** Unfolds the panel where there is room for it, and fetches the script of its settings when they are asked for. */
export function bindPanel(view: LightwellView): void {
  document.querySelector<HTMLDetailsElement>('#panel')!.open = !matchMedia('(max-width: 520px)').matches;
  const fetch = async () => (await import('./settings.js')).bindSettings(view, { BufferAttribute, BufferGeometry, Mesh, MeshStandardMaterial });
  document.querySelector('#settings')!.addEventListener('toggle', fetch, { once: true });
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';
import type { View } from '../element/orbit.js';
import type { Hash } from './camera_hash.js';

/** An entry of /packs.json. */
interface Pack {
  name: string;
  url: string;
}

/**
 * Shows the pack that the URL names, by its file or as it is displayed, or the first of the server's when it names none. More
 * than one can be chosen from. Throws when there is no such pack.
 */
export async function bindPacks(view: LightwellView, hash: Hash): Promise<void> {
  const { wanted } = hash;
  const { packs, change } = await listPacks();
  const title = document.querySelector<HTMLElement>('#title')!;
  const select = document.querySelector<HTMLSelectElement>('#packs')!;
  const show = (camera: View | null) => {
    const { name, url } = packs[select.selectedIndex]!;
    title.textContent = displayName(name);
    document.title = `${displayName(name)} · Lightwell`;
    hash.setPack(name, camera);
    view.setAttribute('src', url);
  };
  select.replaceChildren(...packs.map(({ name }) => new Option(displayName(name))));
  select.addEventListener('change', () => show(null));
  select.selectedIndex = packs.findIndex(({ name }) => wanted === null || [name, displayName(name)].includes(wanted));
  select.hidden = packs.length < 2;
  title.hidden = !select.hidden;
  const tile = async () => (await import('./tiles.js')).bindTiles(view, select, packs);
  if (packs.length > 1) view.addEventListener('load', tile, { once: true });
  if (select.selectedIndex < 0) throw new Error(`This server has no pack${wanted === null ? 's' : ` “${wanted}”`}.`);
  show(hash.view);
  if (change) (await import('./follow.js')).follow(view);
}

async function listPacks(): Promise<{ packs: Pack[]; change?: boolean }> {
  const response = await fetch('packs.json');
  if (!response.ok) throw new Error(`packs.json: the server answers ${response.status}`);
  return response.json();
}

/** "dragon-room.lw.glb" as "dragon-room". */
function displayName(name: string): string {
  return name.replace(/(\.lw)?\.glb$/, '');
}

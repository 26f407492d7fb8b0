// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';
import type { Hash } from './camera_hash.js';

/** A line of /packs.json. */
interface Pack {
  name: string;
  url: string;
}

/** Shows the pack that the URL names, else the first of the server's; more than one can be chosen from. */
export async function bindPacks(view: LightwellView, hash: Hash): Promise<void> {
  const packs = await listPacks();
  const first = packs.find(({ name }) => name === hash.pack) ?? packs[0];
  if (first === undefined) throw new Error('This server has no packs.');
  const title = document.querySelector<HTMLElement>('#title')!;
  const select = document.querySelector<HTMLSelectElement>('#packs')!;
  const show = ({ name, url }: Pack) => {
    title.textContent = displayName(name);
    document.title = `${displayName(name)} · Lightwell`;
    view.setAttribute('src', url);
  };
  select.replaceChildren(...packs.map(({ name }) => new Option(displayName(name), name)));
  select.value = first.name;
  select.hidden = packs.length < 2;
  title.hidden = packs.length >= 2;
  select.addEventListener('change', () => {
    hash.setPack(select.value);
    show(packs.find(({ name }) => name === select.value)!);
  });
  show(first);
}

async function listPacks(): Promise<Pack[]> {
  const response = await fetch('packs.json');
  if (!response.ok) throw new Error(`packs.json: the server answers ${response.status}`);
  const { packs } = (await response.json()) as { packs: Pack[] };
  return packs;
}

/** "dragon-room.lw.glb" as "dragon-room". */
function displayName(name: string): string {
  return name.replace(/(\.lw)?\.glb$/, '');
}

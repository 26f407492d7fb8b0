// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** Of the picture in a tile, in pixels: a few kB each. */
const [WIDTH, HEIGHT] = [144, 96];
const QUALITY = 0.7;
const STYLE = `
#tiles { display: flex; gap: 6px; margin: 0 -16px 10px; padding: 2px 16px; overflow-x: auto; scrollbar-width: thin; }
#tiles button { flex: none; width: 76px; padding: 0 0 2px; overflow: hidden; font-size: 11px; text-overflow: ellipsis; white-space: nowrap; }
#tiles [aria-current='true'] { border-color: var(--light); }
#tiles img, #tiles i { display: block; width: 100%; height: 49px; object-fit: cover; background: linear-gradient(135deg, var(--chosen), transparent); }
`;

/**
 * A tile for each pack of the list, with its picture from when it was shown last; this browser alone keeps those, by the packs' URLs. The
 * page fetches this script when its first pack of several is there: it imports nothing that the page has.
 */
export function bindTiles(view: LightwellView, select: HTMLSelectElement, packs: { url: string }[]): void {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  document.adoptedStyleSheets.push(sheet);
  const keys = packs.map(({ url }) => `lightwell-tile ${new URL(url, location.href).href}`);
  const tiles = keys.map((key, index) => {
    const tile = Object.assign(document.createElement('button'), { title: select.options[index]!.text });
    tile.append(pictureOf(key), tile.title);
    tile.addEventListener('click', () => {
      select.selectedIndex = index;
      select.dispatchEvent(new Event('change'));
    });
    return tile;
  });
  const list = Object.assign(document.createElement('div'), { id: 'tiles' });
  list.append(...tiles);
  document.querySelector('#panel > summary')!.after(list);
  const mark = () => tiles.forEach((tile, index) => tile.setAttribute('aria-current', String(index === select.selectedIndex)));
  const keep = () => {
    const { selectedIndex: index } = select;
    store(keys[index]!, shrink(view));
    tiles[index]!.firstElementChild!.replaceWith(pictureOf(keys[index]!));
  };
  select.addEventListener('change', mark);
  view.on('load', mark);
  view.on('complete', keep);
  mark();
  if (view.complete) keep();
}

/** What was kept, or a plain one. */
function pictureOf(key: string): HTMLElement {
  const kept = read(key);
  return kept === null ? document.createElement('i') : Object.assign(new Image(), { src: kept, alt: '' });
}

/** The middle of the present picture. */
function shrink(view: LightwellView): string {
  const small = Object.assign(document.createElement('canvas'), { width: WIDTH, height: HEIGHT });
  const canvas = view.shadowRoot!.querySelector<HTMLCanvasElement>('canvas:not(.poster)')!;
  view.draw();
  const scale = Math.min(canvas.width / WIDTH, canvas.height / HEIGHT);
  const [width, height] = [WIDTH * scale, HEIGHT * scale];
  const context = small.getContext('2d')!;
  context.fillStyle = getComputedStyle(document.body).getPropertyValue('--ground');
  context.fillRect(0, 0, WIDTH, HEIGHT);
  context.imageSmoothingQuality = 'high';
  context.drawImage(canvas, (canvas.width - width) / 2, (canvas.height - height) / 2, width, height, 0, 0, WIDTH, HEIGHT);
  return small.toDataURL('image/jpeg', QUALITY);
}

/** A browser may keep nothing, or have no room: then tiles are plain. */
function store(key: string, picture: string): void {
  try {
    localStorage.setItem(key, picture);
  } catch {
    return;
  }
}

function read(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

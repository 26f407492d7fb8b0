// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** Of the picture in a tile, in pixels: a few kB each. */
const [WIDTH, HEIGHT] = [144, 96];
const QUALITY = 0.7;
const STYLE = `
#tiles { display: flex; gap: 6px; margin: 0 -16px 10px; padding: 2px 16px; overflow-x: auto; scrollbar-width: thin; }
#tiles button { position: relative; flex: none; width: 76px; padding: 0 0 2px; overflow: hidden; font-size: 11px; text-overflow: ellipsis; white-space: nowrap; }
#tiles [aria-current='true'] { border-color: var(--light); }
#tiles lightwell-view { position: absolute; inset: 0 auto auto 0; width: ${WIDTH}px; height: ${HEIGHT}px; min-height: 0; opacity: 0; }
#tiles img, #tiles i { display: block; width: 100%; height: 49px; object-fit: cover; background: linear-gradient(135deg, var(--chosen), transparent); }
`;

/**
 * A tile for each pack of the list, with its picture from when it was shown last, which this browser alone keeps, by the packs' URLs. Of
 * those that were never shown it is their first picture, once the first pack is complete and the tile can be seen. The page fetches this script when its first pack of
 * several is there: it imports nothing that the page has.
 */
export function bindTiles(view: LightwellView, select: HTMLSelectElement, packs: { url: string }[]): void {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  document.adoptedStyleSheets.push(sheet);
  const keys = packs.map(({ url }) => `lightwell-tile ${new URL(url, location.href).href}`);
  const tiles = keys.map((key, index) => {
    const tile = Object.assign(document.createElement('button'), { title: select.options[index]!.text });
    tile.append(pictureOf(read(key)), tile.title);
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
  const show = (index: number, picture: string) => {
    store(keys[index]!, picture);
    tiles[index]!.querySelector('img, i')!.replaceWith(pictureOf(picture));
  };
  const isPlain = (index: number) => tiles[index]!.querySelector('img') === null;
  let begun = savesData();
  const keep = () => {
    show(select.selectedIndex, shrink(view));
    if (begun) return;
    begun = true;
    packs.forEach(async ({ url }, index) => {
      const picture = isPlain(index) ? await firstPicture(tiles[index]!, url) : null;
      if (picture !== null && isPlain(index)) show(index, picture);
    });
  };
  select.addEventListener('change', mark);
  view.on('load', mark);
  view.on('complete', keep);
  mark();
  if (view.complete) keep();
}

const savesData = () => (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;

/** A pack's first picture, from an element of its own within its tile, once that can be seen; none of one that cannot be shown. */
async function firstPicture(tile: HTMLElement, url: string): Promise<string | null> {
  const view = document.createElement('lightwell-view') as LightwellView;
  view.inert = true;
  view.setAttribute('loading', 'lazy');
  view.setAttribute('src', url);
  const loaded = new Promise<boolean>((resolve) => {
    view.on('load', () => resolve(true));
    view.on('error', () => resolve(false));
  });
  tile.prepend(view);
  try {
    return (await loaded) ? shrink(view) : null;
  } finally {
    view.remove();
  }
}

/** A plain one where there is no picture. */
function pictureOf(picture: string | null): HTMLElement {
  return picture === null ? document.createElement('i') : Object.assign(new Image(), { src: picture, alt: '' });
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

/** A browser may keep nothing, or have no room. */
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

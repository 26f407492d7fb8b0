// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** What one does with a view: fill the screen with it, keep its picture, send it, put it on a page of one's own. */
export function bindSharing(view: LightwellView): void {
  const done = document.querySelector<HTMLOutputElement>('#done')!;
  const bind = (id: string, act: () => Promise<string>) =>
    document.getElementById(id)!.addEventListener('click', () => {
      act().then(
        (words) => (done.value = words),
        (error: unknown) => (done.value = error instanceof Error ? error.message : String(error)),
      );
    });
  bind('full', () => fillScreen());
  bind('picture', () => savePicture(view));
  bind('link', () => copy(location.href, 'The link to this view is copied.'));
  bind('embed', () => copy(embedding(view), 'The HTML of this view is copied.'));
}

async function fillScreen(): Promise<string> {
  if (document.fullscreenElement === null) await document.documentElement.requestFullscreen();
  else await document.exitFullscreen();
  return '';
}

/** Under the pack's name, as a PNG. */
async function savePicture(view: LightwellView): Promise<string> {
  const link = document.createElement('a');
  link.download = `${document.querySelector('#title')!.textContent}.png`;
  link.href = view.toDataURL();
  link.click();
  return `${link.download} is saved.`;
}

/** Where a page is not trusted with the clipboard, the text itself is what there is to copy. */
async function copy(text: string, words: string): Promise<string> {
  try {
    await navigator.clipboard.writeText(text);
    return words;
  } catch {
    return text;
  }
}

/** The element as it is now, for a page that has its script. */
function embedding(view: LightwellView): string {
  const { theta, phi, radius, target } = view.view!;
  const element = document.createElement('lightwell-view');
  const short = (number: number) => Number(number.toFixed(4));
  const attributes = {
    src: new URL(view.getAttribute('src') ?? '', location.href).href,
    'camera-controls': '',
    'camera-orbit': `${short(theta)}rad ${short(phi)}rad ${short(radius)}m`,
    'camera-target': target.map((place) => `${short(place)}m`).join(' '),
    exposure: view.getAttribute('exposure'),
    light: view.getAttribute('light'),
  };
  for (const [name, value] of Object.entries(attributes)) if (value !== null) element.setAttribute(name, value);
  return element.outerHTML.replaceAll('=""', '');
}

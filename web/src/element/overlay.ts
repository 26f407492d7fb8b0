// SPDX-License-Identifier: Apache-2.0
import type { Share } from '../core/protocol.js';
import style from './overlay.css';

let sheet: CSSStyleSheet | undefined;

/** What an element has over its picture: a poster before it, how much has come, and what went wrong. */
export class Overlay {
  readonly #root: ShadowRoot;
  readonly #bar = make('div', 'bar');
  readonly #progress = make('slot');
  readonly #message = make('div', 'message');
  readonly #error = make('slot');
  #poster: HTMLElement | null = null;

  /** Content of the page's own takes the place of the bar and of the words, in the slots "progress" and "error". */
  constructor(root: ShadowRoot) {
    this.#root = root;
    // A page's content security policy may forbid styles in the text of a document.
    sheet ??= new CSSStyleSheet();
    sheet.replaceSync(style);
    root.adoptedStyleSheets = [sheet];
    this.#bar.role = 'progressbar';
    this.#bar.append(make('i'));
    this.#message.role = 'alert';
    this.#progress.name = 'progress';
    this.#progress.append(this.#bar);
    this.#error.name = 'error';
    this.#error.append(this.#message);
    root.append(this.#progress, this.#error);
    this.say('');
  }

  /** A picture's URL, or a picture, until the first frame. */
  setPoster(poster: string | HTMLElement | null): void {
    this.#poster?.remove();
    this.#poster = null;
    if (poster === null) return;
    const picture = typeof poster === 'string' ? Object.assign(make('img'), { src: poster, alt: '' }) : poster;
    picture.classList.add('poster');
    this.#poster = picture;
    this.#progress.before(picture);
  }

  /** Makes a canvas' present picture the poster. */
  keep(canvas: HTMLCanvasElement): void {
    const still = canvas.cloneNode() as HTMLCanvasElement;
    still.getContext('2d')!.drawImage(canvas, 0, 0);
    this.setPoster(still);
  }

  hidePoster(): void {
    this.#poster?.classList.add('gone');
  }

  /** How much has come; null hides the bar. */
  setProgress(share: Share | null): void {
    this.#progress.hidden = share === null;
    const percent = share === null || share.total === 0 ? 0 : Math.round((100 * share.done) / share.total);
    this.#bar.ariaValueNow = String(percent);
    (this.#bar.firstElementChild as HTMLElement).style.width = `${percent}%`;
  }

  /** What went wrong: no more will come. No words hide the message. */
  say(words: string): void {
    this.setProgress(null);
    this.#message.textContent = words;
    this.#error.hidden = words === '';
  }

  /** Puts a canvas below all of it. */
  setCanvas(canvas: HTMLCanvasElement): void {
    this.#root.prepend(canvas);
  }
}

function make<Name extends keyof HTMLElementTagNameMap>(name: Name, className = ''): HTMLElementTagNameMap[Name] {
  return Object.assign(document.createElement(name), { className });
}

// SPDX-License-Identifier: Apache-2.0
//
// An element's children that stand at points of its scene: <button slot="hotspot-door" data-position="1m 0m 2m" data-normal="0 0 1">.
import type { Vector3 } from 'three';
import type { Kit } from './extras.js';
import { glide } from './glide.js';
import { viewOf } from './go_to.js';
import type { LightwellView } from './lightwell_view.js';
import { nearestHit } from './pick.js';

const HOTSPOT = '[slot^="hotspot-"]';
const STYLE = `
slot[name^='hotspot-'] { display: block; position: absolute; left: 0; top: 0; }
::slotted([data-hidden]) { opacity: 0.25; pointer-events: none; }
`;
/** What is before a hotspot by less than this part of its distance does not hide it: coarse surfaces lie a little off. */
const BESIDE = 0.03;
/** From one search for what hides a hotspot to the next, in milliseconds, and beside the time that a search takes. */
const PAUSE = 30;
const REST = 10;

const known = new WeakSet<LightwellView>();

/** Keeps an element's hotspots over their points from now on. */
export function hotspots(view: LightwellView, kit: Kit): void {
  if (known.has(view)) return;
  known.add(view);
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  view.shadowRoot!.adoptedStyleSheets.push(sheet);
  const places = new Places(view);
  new MutationObserver(() => places.find()).observe(view, {
    childList: true,
    subtree: true,
    attributeFilter: ['slot', 'data-position', 'data-normal'],
  });
  places.find();
  view.on('frame', () => places.follow());
  view.addEventListener('click', ({ target }) => {
    const hotspot = (target as Element).closest<HTMLElement>(HOTSPOT);
    const there = hotspot && viewOf(view, hotspot, kit);
    if (there) void glide(view, there);
  });
}

class Places {
  readonly #view: LightwellView;
  readonly #slots = new Map<string, HTMLSlotElement>();
  /** Those behind something, as far as it is known. */
  readonly #behind = new Set<HTMLSlotElement>();
  /** Whether each is behind something is yet to be found for the present picture. */
  #open: HTMLSlotElement[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(view: LightwellView) {
    this.#view = view;
  }

  /** Gives each name a slot. */
  find(): void {
    for (const { slot: name } of this.#view.querySelectorAll(HOTSPOT)) {
      if (this.#slots.has(name)) continue;
      const slot = Object.assign(document.createElement('slot'), { name, hidden: true });
      this.#slots.set(name, slot);
      this.#view.shadowRoot!.append(slot);
    }
    this.follow();
  }

  /** Puts all where the camera sees their points. */
  follow(): void {
    if (this.#view.pack === null) return;
    for (const slot of this.#slots.values()) this.#place(slot);
    this.#open = [...this.#slots.values()];
    this.#timer ??= setTimeout(() => this.#search(), PAUSE);
  }

  #place(slot: HTMLSlotElement): void {
    const [hotspot] = slot.assignedElements() as HTMLElement[];
    const point = hotspot && this.#vector(hotspot.dataset['position']);
    slot.hidden = point === undefined;
    if (point === undefined || hotspot === undefined) return;
    const { camera, clientWidth, clientHeight } = this.#view;
    const normal = this.#vector(hotspot.dataset['normal']);
    const away = normal !== undefined && normal.dot(point.clone().sub(camera.position)) >= 0;
    const { x, y, z } = point.project(camera);
    slot.hidden = Math.abs(z) > 1;
    slot.style.transform = `translate(${((1 + x) / 2) * clientWidth}px, ${((1 - y) / 2) * clientHeight}px) translate(-50%, -50%)`;
    const state = away ? 'away' : this.#behind.has(slot) ? 'behind' : undefined;
    if (state === undefined) delete hotspot.dataset['hidden'];
    else hotspot.dataset['hidden'] = state;
  }

  /** Finds for one after another whether something is before it: each time all triangles are asked, so that it takes a small part of the time. */
  #search(): void {
    this.#timer = undefined;
    const slot = this.#open.pop();
    if (slot === undefined || this.#view.pack === null) return;
    const began = performance.now();
    if (this.#isBehind(slot)) this.#behind.add(slot);
    else this.#behind.delete(slot);
    this.#place(slot);
    this.#timer = setTimeout(() => this.#search(), PAUSE + REST * (performance.now() - began));
  }

  #isBehind(slot: HTMLSlotElement): boolean {
    const { pack, camera } = this.#view;
    const [hotspot] = slot.assignedElements() as HTMLElement[];
    const point = this.#vector(hotspot?.dataset['position']);
    if (pack === null || point === undefined) return false;
    const way = point.sub(camera.position);
    const distance = way.length();
    return nearestHit(pack, camera.position, way.normalize(), (1 - BESIDE) * distance) !== undefined;
  }

  /** Three numbers between spaces, each perhaps with its "m". */
  #vector(text: string | undefined): Vector3 | undefined {
    const numbers = text?.trim().split(/\s+/).map(Number.parseFloat) ?? [];
    if (numbers.length !== 3 || numbers.some(Number.isNaN)) return undefined;
    return this.#view.camera.position.clone().fromArray(numbers);
  }
}

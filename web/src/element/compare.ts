// SPDX-License-Identifier: Apache-2.0
//
// A line down the picture that the visitor moves: to its left without the baked light, to its right with it.
import type { Scene, WebGLRenderer } from 'three';
import { aroundRender } from './around_render.js';
import { beginsWith } from './attribute_life.js';
import type { LightwellView } from './lightwell_view.js';

const MIDDLE = 0.5;
/** By an arrow key, of the width. */
const STEP = 0.05;
const KEYS: Record<string, number> = { ArrowLeft: -STEP, ArrowRight: STEP };
const BAR = { position: 'absolute', inset: '0 auto', width: '36px', marginLeft: '-18px', cursor: 'ew-resize', touchAction: 'none', background: 'linear-gradient(#fff, #fff) center / 2px 100% no-repeat', filter: 'drop-shadow(0 0 1px #000)' };
const GRIP = { position: 'absolute', inset: '0 6px', height: '24px', margin: 'auto 0', borderRadius: '12px', background: '#fff' };

const lines = new WeakMap<LightwellView, Line>();

/** Divides the picture while the attribute `compare` is there; its value says where, 0 to 1 from the left. */
export function compare(view: LightwellView): void {
  const end = beginsWith(view, 'compare');
  if (end !== null && !end.aborted) lines.set(view, new Line(view, end));
  const place = Number.parseFloat(view.getAttribute('compare') ?? '');
  lines.get(view)?.put(Number.isFinite(place) ? place : MIDDLE);
}

class Line {
  readonly #view: LightwellView;
  readonly #bar = document.createElement('div');
  #place = MIDDLE;
  #dividing = false;
  #frame = 0;

  constructor(view: LightwellView, end: AbortSignal) {
    this.#view = view;
    this.#makeBar(end);
    aroundRender(view.scene, end, { after: (renderer, scene) => this.#dividing || this.#drawWithout(renderer, scene) });
    end.addEventListener('abort', () => {
      this.#bar.remove();
      view.invalidate();
    });
  }

  put(place: number): void {
    this.#place = Math.min(1, Math.max(0, place));
    this.#bar.style.left = `${100 * this.#place}%`;
    this.#bar.ariaValueNow = String(Math.round(100 * this.#place));
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#view.draw();
    });
  }

  #makeBar(end: AbortSignal): void {
    const bar = this.#bar;
    bar.tabIndex = 0;
    bar.role = 'slider';
    bar.ariaLabel = bar.title = 'Without baked light to the left, with it to the right: drag, or use the arrow keys';
    Object.assign(bar.style, BAR);
    const grip = document.createElement('b');
    Object.assign(grip.style, GRIP);
    bar.append(grip);
    const say = (place: number) => this.#view.setAttribute('compare', String(Math.min(1, Math.max(0, place))));
    bar.addEventListener('pointerdown', (event) => bar.setPointerCapture(event.pointerId), { signal: end });
    bar.addEventListener('pointermove', ({ clientX, buttons }) => {
      if (buttons === 0) return;
      const { left, width } = this.#view.getBoundingClientRect();
      say((clientX - left) / width);
    }, { signal: end });
    bar.addEventListener('keydown', (event) => {
      const step = KEYS[event.key];
      if (step === undefined) return;
      event.preventDefault();
      say(this.#place + step);
    }, { signal: end });
    this.#view.shadowRoot!.append(bar);
  }

  /** Draws what is to the left of the line anew, without the light of grids and surroundings. */
  #drawWithout(renderer: WebGLRenderer, scene: Scene): void {
    const { pack, camera } = this.#view;
    if (pack === null || renderer.getRenderTarget() !== null) return;
    const { width, height } = renderer.domElement;
    const ratio = renderer.getPixelRatio();
    const grids = pack.grids.filter(({ visible }) => visible);
    const { environmentIntensity } = scene;
    this.#dividing = true;
    for (const grid of grids) grid.visible = false;
    scene.environmentIntensity = 0;
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, (width * this.#place) / ratio, height / ratio);
    renderer.render(scene, camera);
    renderer.setScissorTest(false);
    scene.environmentIntensity = environmentIntensity;
    for (const grid of grids) grid.visible = true;
    this.#dividing = false;
  }
}

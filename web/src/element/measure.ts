// SPDX-License-Identifier: Apache-2.0
import type { Vector3 } from 'three';
import { beginsWith } from './attribute_life.js';
import type { LightwellView } from './lightwell_view.js';
import { pick } from './pick.js';

/** A pointer that goes further than this, in pixels, drags. */
const CLICK = 5;
const SVG = 'http://www.w3.org/2000/svg';
const LABEL = { position: 'absolute', inset: '0 auto auto 0', padding: '2px 8px', borderRadius: '9px', background: '#fffd', color: '#222', font: '600 13px system-ui', pointerEvents: 'none' };

/** A length in the visitor's way to write it. */
const metres = new Intl.NumberFormat(undefined, { style: 'unit', unit: 'meter', maximumSignificantDigits: 3 });

/** Two clicks on the pack show how far apart their points are, while the attribute `measure` is there; escape takes it away. */
export function measure(view: LightwellView): void {
  const end = beginsWith(view, 'measure');
  if (end === null || end.aborted) return;
  const tape = new Tape(view);
  let from: PointerEvent | null = null;
  view.addEventListener('pointerdown', (event) => (from = event.isPrimary ? event : null), { signal: end });
  view.addEventListener('pointerup', (event) => {
    const canvas = event.composedPath()[0] instanceof HTMLCanvasElement;
    if (from === null || !canvas || Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > CLICK) return;
    const hit = pick(view, event);
    if (hit !== undefined) tape.add(hit.point);
  }, { signal: end });
  document.addEventListener('keydown', ({ key }) => key === 'Escape' && view.removeAttribute('measure'), { signal: end });
  view.addEventListener('frame', () => tape.follow(), { signal: end });
  view.style.cursor = 'crosshair';
  end.addEventListener('abort', () => {
    view.style.cursor = '';
    tape.remove();
  });
}

/** A line between two points of the scene, over the picture, with its length. */
class Tape {
  readonly #view: LightwellView;
  readonly #svg = document.createElementNS(SVG, 'svg');
  /** A dark line and a light one in it, to be seen on anything. */
  readonly #lines = [shape('line', { stroke: '#000a', 'stroke-width': '5' }), shape('line', { stroke: '#fff', 'stroke-width': '2' })];
  readonly #ends = [0, 1].map(() => shape('circle', { r: '4', fill: '#fff', stroke: '#000a', 'stroke-width': '2' }));
  readonly #label = Object.assign(document.createElement('output'), { hidden: true });
  #points: Vector3[] = [];

  constructor(view: LightwellView) {
    this.#view = view;
    this.#svg.append(...this.#lines, ...this.#ends);
    this.#svg.setAttribute('aria-hidden', 'true');
    Object.assign(this.#svg.style, { position: 'absolute', inset: '0', width: '100%', height: '100%', pointerEvents: 'none' });
    Object.assign(this.#label.style, LABEL);
    view.shadowRoot!.append(this.#svg, this.#label);
    this.follow();
  }

  /** The third point begins another line. */
  add(point: Vector3): void {
    this.#points = this.#points.length === 1 ? [this.#points[0]!, point] : [point];
    this.follow();
    const [from, to] = this.#points;
    if (from === undefined || to === undefined) return;
    this.#label.value = metres.format(from.distanceTo(to));
    const detail = { metres: from.distanceTo(to), from: from.toArray(), to: to.toArray() };
    this.#view.dispatchEvent(new CustomEvent('measure', { detail }));
  }

  /** Draws what the camera sees of it: nothing of a line that goes behind it. */
  follow(): void {
    const { camera, clientWidth, clientHeight } = this.#view;
    const seen = this.#points.map((point) => point.clone().project(camera));
    const places = seen.map(({ x, y }) => [((1 + x) / 2) * clientWidth, ((1 - y) / 2) * clientHeight] as const);
    const [from, to] = seen.some(({ z }) => Math.abs(z) > 1) ? [] : places;
    place(this.#ends[0]!, from && { cx: from[0], cy: from[1] });
    place(this.#ends[1]!, to && { cx: to[0], cy: to[1] });
    for (const line of this.#lines) place(line, from && to && { x1: from[0], y1: from[1], x2: to[0], y2: to[1] });
    this.#label.hidden = to === undefined;
    if (from && to) this.#label.style.transform = `translate(${(from[0] + to[0]) / 2}px, ${(from[1] + to[1]) / 2}px) translate(-50%, -160%)`;
  }

  remove(): void {
    this.#svg.remove();
    this.#label.remove();
  }
}

function shape(name: 'line' | 'circle', attributes: Record<string, string>): SVGElement {
  const made = document.createElementNS(SVG, name);
  for (const [attribute, value] of Object.entries(attributes)) made.setAttribute(attribute, value);
  return made;
}

/** Puts a shape somewhere, or nowhere. */
function place(shape: SVGElement, attributes: Record<string, number> | undefined): void {
  shape.setAttribute('visibility', attributes === undefined ? 'hidden' : 'visible');
  for (const [attribute, value] of Object.entries(attributes ?? {})) shape.setAttribute(attribute, String(value));
}

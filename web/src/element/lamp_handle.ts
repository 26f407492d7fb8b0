// SPDX-License-Identifier: Apache-2.0

/** Its width, in pixels of the page. */
const SIZE = 80;
/** Nearly at the rim light only grazes; at the rim it would light nothing. */
const RIM = 0.985;
const STEP = 0.05;
const KEYS: Record<string, readonly [number, number]> = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export interface Handle {
  readonly element: HTMLElement;
  /** Puts the knob somewhere, each from -1 to 1, to the right and up, within a circle. */
  put(x: number, y: number): void;
}

/** A ball in the upper right corner with a knob where a lamp's light comes from. `moved` is told of each place of the knob. */
export function createHandle(moved: (x: number, y: number) => void): Handle {
  const element = document.createElement('b');
  const knob = document.createElement('b');
  element.append(knob);
  element.tabIndex = 0;
  element.role = 'application';
  element.ariaLabel = 'Lamp: drag it, or move it with the arrow keys';
  element.title = element.ariaLabel;
  const round = { position: 'absolute', borderRadius: '50%' };
  const ball = 'radial-gradient(circle at 50% 50%, #fff6, #4446 70%)';
  Object.assign(element.style, { ...round, right: '16px', top: '16px', width: `${SIZE}px`, height: `${SIZE}px`, background: ball, touchAction: 'none', cursor: 'grab' });
  Object.assign(knob.style, { ...round, inset: '38%', background: '#ffe9a8', boxShadow: '0 0 6px #fffc, 0 0 2px #000', pointerEvents: 'none' });
  let at: readonly [number, number] = [0, 0];
  const put = (x: number, y: number) => {
    const length = Math.max(1, Math.hypot(x, y) / RIM);
    at = [x / length, y / length];
    knob.style.transform = `translate(${(at[0] * SIZE) / 2}px, ${(-at[1] * SIZE) / 2}px)`;
    moved(...at);
  };
  const drag = ({ clientX, clientY, buttons }: PointerEvent) => {
    if (buttons === 0) return;
    const { left, top } = element.getBoundingClientRect();
    put((2 * (clientX - left)) / SIZE - 1, 1 - (2 * (clientY - top)) / SIZE);
  };
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    drag(event);
  });
  element.addEventListener('pointermove', drag);
  element.addEventListener('keydown', (event) => {
    const way = KEYS[event.key];
    if (way === undefined) return;
    event.preventDefault();
    put(at[0] + STEP * way[0], at[1] + STEP * way[1]);
  });
  return { element, put };
}

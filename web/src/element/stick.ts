// SPDX-License-Identifier: Apache-2.0

/** Its width, in pixels of the page. */
const SIZE = 96;

/** A stick for the thumb in the lower left corner. `moved` is told how far it is pushed, to the right and ahead, each from -1 to 1. */
export function createStick(moved: (right: number, ahead: number) => void): HTMLElement {
  const base = document.createElement('b');
  const knob = document.createElement('b');
  base.append(knob);
  const round = { position: 'absolute', borderRadius: '50%', background: '#8886' };
  Object.assign(base.style, { ...round, left: '16px', bottom: '16px', width: `${SIZE}px`, height: `${SIZE}px`, touchAction: 'none' });
  Object.assign(knob.style, { ...round, inset: '30%', pointerEvents: 'none' });
  const push = (right: number, ahead: number) => {
    knob.style.transform = `translate(${(right * SIZE) / 3}px, ${(-ahead * SIZE) / 3}px)`;
    moved(right, ahead);
  };
  base.addEventListener('pointerdown', ({ pointerId }) => base.setPointerCapture(pointerId));
  base.addEventListener('pointermove', ({ clientX, clientY, buttons }) => {
    if (buttons === 0) return;
    const { left, top } = base.getBoundingClientRect();
    const part = (from: number) => Math.max(-1, Math.min(1, (2 * from) / SIZE - 1));
    push(part(clientX - left), -part(clientY - top));
  });
  for (const end of ['pointerup', 'pointercancel']) base.addEventListener(end, () => push(0, 0));
  return base;
}

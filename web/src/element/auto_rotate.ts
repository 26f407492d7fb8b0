// SPDX-License-Identifier: Apache-2.0
import { beginsWith } from './attribute_life.js';
import type { LightwellView } from './lightwell_view.js';
import { whenMotionIsSeen } from './motion.js';

/** Without input, in milliseconds. */
const REST = 3000;
/** Radians a second: a turn takes a minute. */
const SPEED = (2 * Math.PI) / 60;
/** No frame counts for more, in seconds: after a pause of the page nothing jumps. */
const LONGEST_FRAME = 0.1;

/** Turns the camera slowly around its target while nobody does anything, the attribute `auto-rotate` is there and the element is seen. */
export function autoRotate(view: LightwellView): void {
  const end = beginsWith(view, 'auto-rotate');
  if (end === null || end.aborted) return;
  let [seen, held, timer, frame, time] = [false, false, 0, 0, 0];
  const turn = () => {
    const now = performance.now();
    const seconds = Math.min(LONGEST_FRAME, (now - time) / 1000);
    time = now;
    const from = view.view;
    if (from === null || view.pack === null || view.getAttribute('camera-controls') === 'walk') return;
    view.view = { ...from, theta: from.theta + SPEED * seconds };
    frame = requestAnimationFrame(turn);
  };
  const stop = () => {
    clearTimeout(timer);
    cancelAnimationFrame(frame);
  };
  const wait = () => {
    stop();
    if (!seen || held) return;
    timer = window.setTimeout(() => {
      time = performance.now();
      turn();
    }, REST);
  };
  const listen = (target: EventTarget, events: string[], act: () => void) => {
    for (const name of events) target.addEventListener(name, act, { signal: end, passive: true });
  };
  const hold = (holds: boolean) => () => {
    if (holds === held) return;
    held = holds;
    wait();
  };
  listen(view, ['pointerdown'], hold(true));
  listen(window, ['pointerup', 'pointercancel'], hold(false));
  listen(view, ['wheel', 'keydown', 'load'], wait);
  whenMotionIsSeen(view, end, (isSeen) => {
    seen = isSeen;
    wait();
  });
  end.addEventListener('abort', stop);
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from './lightwell_view.js';

/** Tells, now and whenever it changes, whether motion would be seen: the element is in sight, and the visitor does not prefer less of it. */
export function whenMotionIsSeen(view: LightwellView, end: AbortSignal, tell: (seen: boolean) => void): void {
  const still = matchMedia('(prefers-reduced-motion: reduce)');
  let inSight = false;
  const look = () => tell(inSight && !still.matches);
  still.addEventListener('change', look, { signal: end });
  const sight = new IntersectionObserver((entries) => {
    inSight = entries.at(-1)!.isIntersecting;
    look();
  });
  sight.observe(view);
  end.addEventListener('abort', () => sight.disconnect());
}

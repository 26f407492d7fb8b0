// SPDX-License-Identifier: Apache-2.0
//
// What few visitors ask for. The element fetches this script the first time that one of them does: it imports nothing that the element
// has, and works on what it is given (docs/decisions/008-size-of-the-page.md).
import type { DirectionalLight } from 'three';
import type { parseQuantity, parseView } from './attributes.js';
import { animate } from './animation.js';
import { autoRotate } from './auto_rotate.js';
import { compare } from './compare.js';
import type { LightwellView } from './lightwell_view.js';
import { measure } from './measure.js';
import { rakingLight } from './raking_light.js';
import { walk } from './walk.js';

export { focus } from './focus.js';
export { goTo } from './go_to.js';
export { hotspots } from './hotspots.js';

/** What the element has, so that this script need not bring it. */
export interface Kit {
  DirectionalLight: typeof DirectionalLight;
  parseQuantity: typeof parseQuantity;
  parseView: typeof parseView;
}

/** What begins when an attribute says so. */
export const attributes: Record<string, (view: LightwellView, kit: Kit) => void> = {
  animation: animate,
  'auto-rotate': autoRotate,
  'camera-controls': walk,
  compare,
  measure,
  'raking-light': rakingLight,
};

// SPDX-License-Identifier: Apache-2.0
//
// Registers <lightwell-view>. Where there is no document, importing it does nothing.
import { LightwellView } from './lightwell_view.js';

export { LightwellView };
export type { LightwellViewAttributes } from './attributes.js';
export type { LightwellViewDetails, LightwellViewEventMap } from './events.js';
export type { View } from './orbit.js';

declare global {
  interface HTMLElementTagNameMap {
    'lightwell-view': LightwellView;
  }
}

const registry = globalThis.customElements as CustomElementRegistry | undefined;
if (registry?.get('lightwell-view') === undefined) registry?.define('lightwell-view', LightwellView);

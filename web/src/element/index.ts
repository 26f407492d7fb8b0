// SPDX-License-Identifier: Apache-2.0
//
// Registers <lightwell-view>.
import { LightwellView } from './lightwell_view.js';

export { LightwellView };
export type { View } from './orbit.js';

if (customElements.get('lightwell-view') === undefined) customElements.define('lightwell-view', LightwellView);

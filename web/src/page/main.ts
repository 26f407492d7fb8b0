// SPDX-License-Identifier: Apache-2.0
//
// The page: a <lightwell-view> that fills the window, and a panel.
import '../element/index.js';
import type { LightwellView } from '../element/lightwell_view.js';
import { bindHash } from './camera_hash.js';
import { bindNotice } from './notice.js';
import { bindPacks } from './pack_list.js';
import { bindPanel } from './panel.js';
import { bindProgress } from './progress.js';

const view = document.querySelector<LightwellView>('#view')!;
bindProgress(view);
bindPanel(view);
const notice = bindNotice(view);
const hash = bindHash(view);
bindPacks(view, hash).catch((error: unknown) => notice.fail(error instanceof Error ? error.message : String(error)));

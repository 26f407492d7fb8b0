// SPDX-License-Identifier: Apache-2.0
import type { DirectKit } from '../direct_kit.js';

/** three.js, as far as it is needed here; given before anything else is done. */
export let three: DirectKit;

export function useKit(kit: DirectKit): void {
  three = kit;
}

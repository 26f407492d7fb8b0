// SPDX-License-Identifier: Apache-2.0

/** Something that takes a WebGL context to be seen. */
export interface ContextHolder {
  /** Whether it is about to be seen. */
  readonly near: boolean;
  /** Whether it can do without, since nobody sees it or its picture is still. */
  readonly spare: boolean;
  takeContext(): void;
  giveContextBack(): void;
}

const holders = new Set<ContextHolder>();
const waiting = new Set<ContextHolder>();

/** Contexts that are held at once. Browsers take the oldest away from 16 on, those of phones from 8. */
const most = () => (matchMedia('(pointer: coarse)').matches ? 6 : 12);

/** Lets a holder take a context: at once, or when one is to be had. */
export function wantContext(holder: ContextHolder): void {
  if (!holders.has(holder)) waiting.add(holder);
  serveContexts();
}

/** Takes a context back, or the wish for one. */
export function dropContext(holder: ContextHolder): void {
  waiting.delete(holder);
  if (!holders.delete(holder)) return;
  holder.giveContextBack();
  serveContexts();
}

const nearFirst = (a: ContextHolder, b: ContextHolder) => Number(b.near) - Number(a.near);

/** Those near the screen come first, and before those that can do without. Call it when a holder's `near` or `spare` has changed. */
export function serveContexts(): void {
  for (const next of [...waiting].sort(nearFirst)) {
    if (holders.size >= most()) {
      const spare = [...holders].filter((holder) => holder.spare).sort(nearFirst).at(-1);
      if (spare === undefined || !next.near) return;
      holders.delete(spare);
      spare.giveContextBack();
    }
    waiting.delete(next);
    holders.add(next);
    next.takeContext();
  }
}

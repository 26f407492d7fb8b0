// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from './lightwell_view.js';

/** What has begun in each element, by attribute. */
const lives = new WeakMap<LightwellView, Map<string, AbortSignal>>();

/** A signal for what begins now and ends when the attribute is taken away; null when it has begun before. */
export function beginsWith(view: LightwellView, attribute: string): AbortSignal | null {
  const begun = lives.get(view) ?? new Map<string, AbortSignal>();
  lives.set(view, begun);
  if (begun.get(attribute)?.aborted === false) return null;
  const end = new AbortController();
  begun.set(attribute, end.signal);
  const watch = new MutationObserver(() => view.hasAttribute(attribute) || end.abort());
  watch.observe(view, { attributeFilter: [attribute] });
  end.signal.addEventListener('abort', () => watch.disconnect());
  if (!view.hasAttribute(attribute)) end.abort();
  return end.signal;
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** Between two looks at the server, in milliseconds. */
const PAUSE = 1000;

/**
 * Shows the pack anew whenever the server has another one under its name; the camera stays. The page fetches this script where the
 * server says that packs change: it imports nothing that the page has.
 */
export function follow(view: LightwellView): void {
  let known: { src: string | null; tag: string } | null = null;
  const look = async () => {
    const src = view.getAttribute('src');
    const tag = src === null ? null : await tagOf(src);
    if (tag !== null) {
      if (known !== null && known.src === src && known.tag !== tag) show(view, src!);
      known = { src, tag };
    }
    setTimeout(look, PAUSE);
  };
  void look();
}

function show(view: LightwellView, src: string): void {
  const camera = view.loaded ? view.view : null;
  view.setAttribute('src', src);
  if (camera !== null) view.view = camera;
}

/** What tells a file from another one under the same name; null when the server does not answer. */
async function tagOf(url: string): Promise<string | null> {
  try {
    const response = await fetch(url, { method: 'HEAD', cache: 'no-store' });
    return response.ok ? response.headers.get('ETag') : null;
  } catch {
    return null;
  }
}

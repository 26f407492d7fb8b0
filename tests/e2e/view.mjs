// SPDX-License-Identifier: Apache-2.0
//
// What tests say to the page's <lightwell-view>.

/** Waits until the element is in the document and knows its properties. */
export const defined = (page) => page.waitForFunction(() => document.querySelector('lightwell-view')?.shadowRoot);

export const loaded = (page) => page.waitForFunction(() => document.querySelector('lightwell-view')?.loaded);

/** Waits until all has come and is drawn; without `timeout` as long as for anything else. */
export const complete = (page, timeout = undefined) =>
  page.waitForFunction(() => document.querySelector('lightwell-view')?.complete, undefined, { timeout });

export const progress = (page) => page.evaluate(() => document.querySelector('lightwell-view').progress);

/** Runs in the page before its scripts: pauses the stream when `bytes` of the file have come, once. */
export function pauseAfter(bytes) {
  return `addEventListener('DOMContentLoaded', () => {
    const view = document.querySelector('lightwell-view');
    const listener = ({ detail }) => {
      if (!detail || detail.bytes.done < ${bytes}) return;
      view.removeEventListener('progress', listener);
      view.pause();
      globalThis.paused = true;
    };
    view.addEventListener('progress', listener);
  });`;
}

export const paused = (page) => page.waitForFunction(() => globalThis.paused);

export const resume = (page) => page.evaluate(() => document.querySelector('lightwell-view').resume());

/** Waits for the words of the page's notice; an empty pattern waits until there is none. */
export function notice(page, pattern) {
  return page.waitForFunction(
    (source) => {
      const element = document.querySelector('#notice');
      return source === '' ? element.hidden : !element.hidden && new RegExp(source).test(element.textContent);
    },
    pattern,
  );
}

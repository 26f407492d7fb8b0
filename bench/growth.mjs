// SPDX-License-Identifier: Apache-2.0
//
// growth.mjs PACK: how many faces the page shows after how many seconds, and after how many all is there, at 1280 x 800, while PACK
// comes from this machine as fast as it can; in Chromium on llvmpipe.
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { startServe } from '../tests/e2e/servers.mjs';
import { complete } from '../tests/e2e/view.mjs';

/** A million triangles in software take their time, on a busy machine the more; milliseconds. */
const PATIENCE = 300_000;

/** Runs in the page before its scripts: notes the faces of each level and the end, with the time since the page began. */
const NOTE_LEVELS = `addEventListener('DOMContentLoaded', () => {
  const view = document.querySelector('lightwell-view');
  globalThis.notes = [];
  const note = (what) => notes.push({ ...what, seconds: Math.round(performance.now()) / 1000 });
  const noteFaces = () => {
    let indices = 0;
    view.pack.traverse(({ geometry }) => (indices += geometry ? geometry.drawRange.count : 0));
    note({ faces: indices / 3 });
  };
  view.addEventListener('load', () => (noteFaces(), view.pack.addEventListener('geometry', noteFaces)));
  view.addEventListener('complete', () => note({ complete: true }));
});`;

const pack = process.argv[2];
if (pack === undefined) throw new Error('usage: node bench/growth.mjs PACK');
const server = await startServe(pack);
const browser = await launch();
try {
  const { page } = await openPage(browser, { width: 1280, height: 800, init: NOTE_LEVELS });
  await page.goto(server.url);
  await complete(page, PATIENCE);
  for (const line of await page.evaluate(() => globalThis.notes)) console.log(JSON.stringify(line));
} finally {
  await browser.close();
  await server.close();
}

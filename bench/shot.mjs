// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a pack on the page.
import { writeFileSync } from 'node:fs';
import { complete } from '../tests/e2e/view.mjs';

/** A million triangles in software take their time, on a busy machine the more; milliseconds. */
const PATIENCE = 300_000;
/** Of the GPU's time in a frame, milliseconds: shadows become soft as fast as they can. */
const ALL_TIME = 10_000;

/** Opens the page of a server at `url` and waits until all of the pack is there. */
export async function openPack(page, url) {
  page.setDefaultTimeout(PATIENCE);
  await page.goto(url);
  await complete(page, PATIENCE);
}

/**
 * Waits until the shadows are those of so many points of each lamp, or of all that there will be, or until the seconds are over; gives
 * how many there are, Infinity for all.
 */
export function softenShadows(page, points, seconds) {
  return page.evaluate(
    async ([wanted, milliseconds, end]) => {
      const view = document.querySelector('lightwell-view');
      const { pack } = view;
      pack.setShadows('soft', milliseconds);
      // A frame finds out whether the camera has moved.
      view.draw();
      const started = performance.now();
      while (pack.shadowSamples < wanted && performance.now() - started < end) await new Promise(requestAnimationFrame);
      return pack.shadowSamples;
    },
    [points, ALL_TIME, 1000 * seconds],
  );
}

/** Writes the present picture as PNG. */
export async function shoot(page, file) {
  const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
  writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
}

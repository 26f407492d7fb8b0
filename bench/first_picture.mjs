// SPDX-License-Identifier: Apache-2.0
//
// first_picture.mjs PACK...: how long after the address was entered the first picture of `lightwell serve PACK` is on the screen, page
// and script included, over a line of 10 Mbit/s with 50 ms from end to end, nothing in the browser's cache; the least of three times,
// since what a busy machine adds is no part of it, and how much of it the scripts and the drawing took. Chromium on llvmpipe.
import { basename } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { startServe } from '../tests/e2e/servers.mjs';

const BYTES_PER_SECOND = 10e6 / 8;
const LATENCY = 50;
const TURNS = 3;

/** Runs in the page before its scripts: notes when a picture with something in it has been drawn. */
const NOTE_PICTURE = `{
  const { drawElements } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.drawElements = function (...values) {
    // The second frame from here begins when what is drawn now is on the screen.
    if (values[1] > 0 && globalThis.shown === undefined) {
      globalThis.shown = 0;
      requestAnimationFrame(() => requestAnimationFrame(() => (globalThis.shown = performance.now())));
    }
    return drawElements.apply(this, values);
  };
}`;

async function timeFirstPicture(browser, url) {
  const { page, close } = await openPage(browser, { width: 960, height: 540, init: NOTE_PICTURE });
  try {
    const session = await page.context().newCDPSession(page);
    await session.send('Network.enable');
    await session.send('Network.setCacheDisabled', { cacheDisabled: true });
    await session.send('Network.emulateNetworkConditions', { offline: false, latency: LATENCY, downloadThroughput: BYTES_PER_SECOND, uploadThroughput: BYTES_PER_SECOND });
    await session.send('Performance.enable');
    await page.goto(url, { waitUntil: 'commit' });
    await page.waitForFunction(() => globalThis.shown > 0);
    const { metrics } = await session.send('Performance.getMetrics');
    const busy = metrics.find(({ name }) => name === 'TaskDuration').value;
    return { seconds: (await page.evaluate(() => globalThis.shown)) / 1000, busy };
  } finally {
    await close();
  }
}

const browser = await launch();
console.log('| pack | first picture, s | of it the page’s thread was busy, s |\n|---|---|---|');
for (const pack of process.argv.slice(2)) {
  const server = await startServe(pack);
  const times = [];
  for (let turn = 0; turn < TURNS; turn++) times.push(await timeFirstPicture(browser, server.url));
  await server.close();
  const { seconds, busy } = times.reduce((best, time) => (time.seconds < best.seconds ? time : best));
  console.log(`| ${basename(pack)} | ${seconds.toFixed(2)} | ${busy.toFixed(2)} |`);
}
await browser.close();

// SPDX-License-Identifier: Apache-2.0
//
// frame.mjs PACK: how long a frame takes at 480 x 270 with the light grid and without (20 alternating pairs, the median of their
// ratio), and while PACK streams in (95th percentile). Frames are timed to the end of a read back, in Chromium on llvmpipe. The
// same ratio by the processors' time instead of the clock's is what a busy machine disturbs least.
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { WEB } from '../tests/e2e/dependencies.mjs';
import { startStaticServer } from '../tests/e2e/static_server.mjs';
import { complete } from '../tests/e2e/view.mjs';

const PAIRS = 20;
const TURNS = 6;
/** The processors' time is counted in hundredths of a second: enough frames to make little of that. */
const TURN_FRAMES = 10;
/** A million triangles in software take their time, on a busy machine the more; milliseconds. */
const PATIENCE = 300_000;

/** Runs in the page before its scripts: times each of its animation frames that draws a picture. */
const TIME_FRAMES = `{
  globalThis.frameTimes = [];
  const { drawElements } = WebGL2RenderingContext.prototype;
  let drew = null;
  WebGL2RenderingContext.prototype.drawElements = function (...values) { if (values[1] > 0) drew = this; return drawElements.apply(this, values); };
  const request = globalThis.requestAnimationFrame.bind(globalThis);
  globalThis.requestAnimationFrame = (callback) => request((time) => {
    drew = null;
    const start = performance.now();
    callback(time);
    if (drew === null) return;
    drew.readPixels(0, 0, 1, 1, drew.RGBA, drew.UNSIGNED_BYTE, new Uint8Array(4));
    globalThis.frameTimes.push(performance.now() - start);
  });
}`;

/** Runs in the page: milliseconds of each pair of frames, with the grid and without; a first pair compiles the shaders. */
function timePairs(pairs) {
  const view = document.querySelector('lightwell-view');
  const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
  const time = (light) => {
    view.setAttribute('light', light);
    view.draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const start = performance.now();
    view.draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - start;
  };
  time('all');
  time('direct');
  return Array.from({ length: pairs }, () => [time('all'), time('direct')]);
}

/** Runs in the page: draws frames of a light. */
function drawFrames({ light, count }) {
  const view = document.querySelector('lightwell-view');
  const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
  view.setAttribute('light', light);
  for (let i = 0; i < count; i++) {
    view.draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}

/** Seconds for which processors have been busy with Chromium's GPU process, in which llvmpipe draws. */
async function processorSeconds(session) {
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  return processInfo.find(({ type }) => type === 'GPU').cpuTime;
}

/** Milliseconds of the processors for a frame of each light, the least of its turns. A first frame of a turn draws shadows. */
async function processorTimes(page, session, lights) {
  const times = lights.map(() => Infinity);
  for (let turn = 0; turn < TURNS; turn++) {
    for (const [i, light] of lights.entries()) {
      await page.evaluate(drawFrames, { light, count: 1 });
      const start = await processorSeconds(session);
      await page.evaluate(drawFrames, { light, count: TURN_FRAMES });
      times[i] = Math.min(times[i], (1000 * ((await processorSeconds(session)) - start)) / TURN_FRAMES);
    }
  }
  return times;
}

const quantile = (values, share) => values.toSorted((a, b) => a - b)[Math.floor(share * (values.length - 1))];

const pack = process.argv[2];
if (pack === undefined) throw new Error('usage: node bench/frame.mjs PACK');
const server = await startStaticServer({
  '/': `${WEB}dist`,
  '/pack.lw.glb': pack,
  '/packs.json': { text: '{"packs": [{"name": "pack.lw.glb", "url": "/pack.lw.glb"}]}', type: 'application/json' },
});
const browser = await launch();
try {
  const { page } = await openPage(browser, { width: 480, height: 270, init: TIME_FRAMES });
  await page.goto(server.url);
  await complete(page, PATIENCE);
  const streaming = await page.evaluate(() => globalThis.frameTimes);
  const pairs = await page.evaluate(timePairs, PAIRS);
  const [busyWith, busyWithout] = await processorTimes(page, await browser.newBrowserCDPSession(), ['all', 'direct']);
  const median = (values) => quantile(values, 0.5);
  console.log(
    JSON.stringify({
      frame_with_grid_ms: median(pairs.map(([grid]) => grid)),
      frame_without_grid_ms: median(pairs.map(([, without]) => without)),
      ratio_median: median(pairs.map(([grid, without]) => grid / without)),
      processor_with_grid_ms: busyWith,
      processor_without_grid_ms: busyWithout,
      processor_ratio: busyWith / busyWithout,
      streaming_frames: streaming.length,
      streaming_median_ms: median(streaming),
      streaming_p95_ms: quantile(streaming, 0.95),
    }),
  );
} finally {
  await browser.close();
  await server.close();
}

// SPDX-License-Identifier: Apache-2.0
//
// frame.mjs PACK [OTHER]: how long a frame takes at 480 x 270 with the light grid and without (20 alternating pairs, the median of their
// ratio), and while PACK streams in (95th percentile); then the same of PACK beside OTHER, the same scene with another grid. Frames
// are timed to the end of a read back, in Chromium on llvmpipe. The same ratio by the processors' time instead of the clock's is what
// a busy machine disturbs least.
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

/** Runs in the page: milliseconds of a frame of a light, after one that compiles its shaders. */
function timeFrame(light) {
  const view = document.querySelector('lightwell-view');
  const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
  const draw = () => {
    view.draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  };
  view.setAttribute('light', light);
  draw();
  const start = performance.now();
  draw();
  return performance.now() - start;
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

/** Milliseconds of the processors for a frame of each { page, light }, the least of its turns. A first frame of a turn draws shadows. */
async function processorTimes(session, frames) {
  const times = frames.map(() => Infinity);
  for (let turn = 0; turn < TURNS; turn++) {
    for (const [i, { page, light }] of frames.entries()) {
      await page.evaluate(drawFrames, { light, count: 1 });
      const start = await processorSeconds(session);
      await page.evaluate(drawFrames, { light, count: TURN_FRAMES });
      times[i] = Math.min(times[i], (1000 * ((await processorSeconds(session)) - start)) / TURN_FRAMES);
    }
  }
  return times;
}

const quantile = (values, share) => values.toSorted((a, b) => a - b)[Math.floor(share * (values.length - 1))];
const median = (values) => quantile(values, 0.5);

/** What one frame takes beside another, each { name, page, light }, in turn: by the clock and by the processors' time. */
async function compare(session, frames) {
  const time = ({ page, light }) => page.evaluate(timeFrame, light);
  for (const frame of frames) await time(frame);
  const pairs = [];
  for (let i = 0; i < PAIRS; i++) pairs.push([await time(frames[0]), await time(frames[1])]);
  const busy = await processorTimes(session, frames);
  return {
    ...Object.fromEntries(frames.map(({ name }, i) => [`frame_${name}_ms`, median(pairs.map((pair) => pair[i]))])),
    ratio_median: median(pairs.map(([one, other]) => one / other)),
    ...Object.fromEntries(frames.map(({ name }, i) => [`processor_${name}_ms`, busy[i]])),
    processor_ratio: busy[0] / busy[1],
  };
}

/** Opens the page of a pack and waits until all of it is there. */
async function openViewer(browser, name) {
  const { page } = await openPage(browser, { width: 480, height: 270, init: TIME_FRAMES });
  await page.goto(`${server.url}?pack=${name}`);
  await complete(page, PATIENCE);
  return page;
}

/** Of two pages neither is to draw samples of soft shadows while the other is timed. */
const hardenShadows = (page) => page.evaluate(() => document.querySelector('lightwell-view').setAttribute('shadows', 'hard'));

const [pack, other] = process.argv.slice(2);
if (pack === undefined) throw new Error('usage: node bench/frame.mjs PACK [OTHER]');
const packs = ['pack.lw.glb', 'other.lw.glb'].map((name) => ({ name, url: `/${name}` }));
const server = await startStaticServer({
  '/': `${WEB}dist`,
  '/pack.lw.glb': pack,
  '/other.lw.glb': other ?? pack,
  '/packs.json': { text: JSON.stringify({ packs }), type: 'application/json' },
});
const browser = await launch();
try {
  const session = await browser.newBrowserCDPSession();
  const page = await openViewer(browser, 'pack.lw.glb');
  const streaming = await page.evaluate(() => globalThis.frameTimes);
  const withGrid = { name: 'with_grid', page, light: 'all' };
  const figures = {
    ...(await compare(session, [withGrid, { name: 'without_grid', page, light: 'direct' }])),
    streaming_frames: streaming.length,
    streaming_median_ms: median(streaming),
    streaming_p95_ms: quantile(streaming, 0.95),
  };
  console.log(JSON.stringify(figures));
  if (other !== undefined) {
    await hardenShadows(page);
    const second = await openViewer(browser, 'other.lw.glb');
    await hardenShadows(second);
    const frames = [{ ...withGrid, name: 'of_pack' }, { name: 'of_other', page: second, light: 'all' }];
    console.log(JSON.stringify(await compare(session, frames)));
  }
} finally {
  await browser.close();
  await server.close();
}

// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startServe } from './servers.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { complete } from './view.mjs';

/** Bytes a second of each response: the light comes in many states, and each stays a while. */
const SLOW = 100_000;
/** Of the final light. The eight corners alone give nine tenths of it everywhere in the sample; what has not come is black. */
const DARKEST = 0.5;
/** Tiles darker than this in the end, of 255, are not looked at: walls that face away, and what lies outside. */
const DARK = 24;

const TILE = 20;
/** Runs in the page before its scripts: notes how bright each tile of the picture is in every frame. */
const WATCH_TILES = `
globalThis.frames = [];
const watch = () => {
  const view = document.querySelector('lightwell-view');
  view.draw();
  const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
  const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const across = width / ${TILE};
  const tiles = new Float32Array(across * (height / ${TILE}));
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      tiles[Math.floor(y / ${TILE}) * across + Math.floor(x / ${TILE})] += pixels[4 * (y * width + x) + 1] / ${TILE ** 2};
  frames.push([...tiles]);
  if (!view.complete) requestAnimationFrame(watch);
};
addEventListener('DOMContentLoaded', () => {
  const view = document.querySelector('lightwell-view');
  view.setAttribute('light', 'indirect');
  view.setAttribute('strategy', 'geometry');
  view.addEventListener('firstframe', watch, { once: true });
});`;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 5_000);

const browser = await forAllTests(launch());

test('the light is there with the first frame, and no part of the picture is dark on the way', async (t) => {
  const server = await forTest(t, startServe(PACK));
  const relay = await forTest(t, startSlowRelay(server.url, SLOW));
  const { page, errors } = await forTest(t, openPage(browser, { init: WATCH_TILES }));
  await page.goto(relay.url);
  await complete(page);
  const frames = await page.evaluate(() => globalThis.frames);
  const last = frames.at(-1);
  const bright = last.map((value, tile) => [value, tile]).filter(([value]) => value > DARK);
  assert.ok(bright.length > 20, `only ${bright.length} tiles are lit`);
  assert.ok(new Set(frames.map((tiles) => tiles.map(Math.round).join())).size >= 3, 'the light came in one piece');
  const darkest = Math.min(...frames.flatMap((tiles) => bright.map(([value, tile]) => tiles[tile] / value)));
  assert.ok(darkest > DARKEST, `a tile had ${darkest} of its light`);
  assert.deepEqual(errors, []);
});

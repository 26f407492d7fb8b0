// SPDX-License-Identifier: Apache-2.0
//
// What a small GPU cannot hold is made smaller, or refused in words.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startServe } from './servers.mjs';
import { complete, notice } from './view.mjs';

/** Runs in a page before its scripts: a limit of WebGL is `value`; `sizes` collects those of the textures that are made. */
const limit = (name, value) => `{
  globalThis.sizes = [];
  const prototype = WebGL2RenderingContext.prototype;
  const { getParameter, texStorage2D, texImage2D } = prototype;
  prototype.getParameter = function (parameter) { return parameter === prototype.${name} ? ${value} : getParameter.call(this, parameter); };
  prototype.texStorage2D = function (...values) { sizes.push(...values.slice(3, 5)); return texStorage2D.apply(this, values); };
  prototype.texImage2D = function (...values) { sizes.push(...values.slice(3, 5)); return texImage2D.apply(this, values); };
}`;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 1_000);
/** The sample's texture is of as many texels in width and height. */
const SAMPLE = 256;
const SMALL = 64;

const browser = await forAllTests(launch());
const server = await forAllTests(startServe(PACK));

test('a texture too large for the GPU is shown as large as it can be', async (t) => {
  const { page, errors } = await forTest(t, openPage(browser, { init: limit('MAX_TEXTURE_SIZE', SMALL) }));
  await page.goto(server.url);
  await complete(page);
  const largest = await page.evaluate(() => Math.max(...globalThis.sizes));
  assert.equal(largest, SMALL);
  const glError = await page.evaluate(() =>
    document.querySelector('lightwell-view').shadowRoot.querySelector('canvas').getContext('webgl2').getError(),
  );
  assert.equal(glError, 0);
  assert.deepEqual(errors, []);
});

test('a light grid too large for the GPU is refused in words', async (t) => {
  const { page } = await forTest(t, openPage(browser, { init: limit('MAX_3D_TEXTURE_SIZE', SMALL) }));
  await page.goto(server.url);
  await notice(page, 'light grid .* GPU');
  const largest = await page.evaluate(() => Math.max(0, ...globalThis.sizes));
  assert.ok(largest < SAMPLE, `a texture of ${largest} texels was made for nothing`);
});

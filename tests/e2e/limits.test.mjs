// SPDX-License-Identifier: Apache-2.0
//
// What a small GPU cannot hold is made smaller, or refused in words.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { replaceInJson } from './pack_edits.mjs';
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

/** Each states another size of its image, in its JSON alone: a larger one, and one that only a page that asks for it makes room for. */
const WRONG = replaceInJson(PACK, `${folder}/wrong.lw.glb`, `"width":${SAMPLE},`, `"width":${SAMPLE + 1},`);
const HUGE = replaceInJson(PACK, `${folder}/huge.lw.glb`, `"width":${SAMPLE},"height":${SAMPLE},`, `"width":9e5,"height":100,`);

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

test('an image of another size than its pack states is refused in words, and the preview stays', async (t) => {
  const server = await forTest(t, startServe(WRONG));
  const { page } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await notice(page, 'image .* another size than the pack states');
});

test('an image of more than 64 megapixels stays coarse, unless the page asks for it', async (t) => {
  const server = await forTest(t, startServe(HUGE));
  const { page, errors } = await forTest(t, openPage(browser, { init: limit('MAX_TEXTURE_SIZE', SMALL) }));
  const warnings = [];
  page.on('console', (message) => message.type() === 'warning' && warnings.push(message.text()));
  const sizeOfMap = () =>
    page.evaluate(() => {
      let size;
      document.querySelector('lightwell-view').pack.traverse(({ material }) => {
        if (material?.map) size = [material.map.image.width, material.map.image.height];
      });
      return size;
    });
  await page.goto(server.url);
  await complete(page);
  const [width, height] = await sizeOfMap();
  assert.ok(width < SMALL && width === height, `the preview is of ${width} x ${height} texels`);
  assert.ok(warnings.some((text) => /900000 x 100 pixels .* maxImageMegapixels/.test(text)), warnings.join());
  assert.deepEqual(errors, []);
  // Nine hundred thousand texels become as many as the GPU takes; what comes then is another image.
  const message = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    const failure = new Promise((resolve) => view.addEventListener('error', ({ detail }) => resolve(detail.message), { once: true }));
    view.setAttribute('max-image-megapixels', '100');
    view.setAttribute('src', `${view.getAttribute('src')}?again`);
    return failure;
  });
  assert.match(message, /another size than the pack states/);
  assert.deepEqual(await sizeOfMap(), [SMALL, 1]);
});

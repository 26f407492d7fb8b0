// SPDX-License-Identifier: Apache-2.0
//
// The attribute compare: to the left of a line the picture is as without the baked light, to its right as with it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

const SIZE = { width: 320, height: 180 };
/** On the line itself a pixel is of both. */
const MARGIN = 2;
/** Of 255: the same shader in another program may round otherwise. */
const ROUNDING = 1;

const PACK = bake('box-small', `${temporaryFolder()}/box.lw.glb`);
const browser = await forAllTests(launch());

async function open(t) {
  const body = '<lightwell-view src="box.lw.glb" shadows="hard" style="position: absolute; inset: 0"></lightwell-view>';
  const server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/box.lw.glb': PACK }));
  const { page, errors } = await forTest(t, openPage(browser, SIZE));
  await page.goto(server.url);
  await complete(page);
  await page.evaluate(() => (globalThis.view = document.querySelector('lightwell-view')));
  return { page, errors };
}

/** The pixels with some attributes, in rows of RGBA from the top. */
const pixels = (page, attributes) =>
  page.evaluate(async (wanted) => {
    for (const name of ['light', 'compare']) if (!(name in wanted)) view.removeAttribute(name);
    for (const [name, value] of Object.entries(wanted)) view.setAttribute(name, value);
    // The script of what few ask for comes in its own time.
    const line = () => view.shadowRoot.querySelector('[role=slider]')?.ariaValueNow;
    const expected = 'compare' in wanted ? String(Math.round(100 * wanted.compare)) : undefined;
    while (line() !== expected) await new Promise((resolve) => setTimeout(resolve, 50));
    const image = new Image();
    image.src = view.toDataURL();
    await image.decode();
    const context = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height }).getContext('2d');
    context.drawImage(image, 0, 0);
    return [...context.getImageData(0, 0, image.width, image.height).data];
  }, attributes);

/** How many pixels of the columns [from, to) differ. */
function differing(a, b, from, to) {
  let count = 0;
  for (let y = 0; y < SIZE.height; y++)
    for (let x = from; x < to; x++) {
      const i = 4 * (y * SIZE.width + x);
      if ([0, 1, 2].some((c) => Math.abs(a[i + c] - b[i + c]) > ROUNDING)) count++;
    }
  return count;
}

test('the picture is divided where the value says', async (t) => {
  const { page, errors } = await open(t);
  const all = await pixels(page, {});
  const direct = await pixels(page, { light: 'direct' });
  assert.ok(differing(all, direct, 0, SIZE.width) > 0.9 * SIZE.width * SIZE.height, 'the bounced light is seen everywhere');
  for (const share of [0, 0.25, 0.75, 1]) {
    const divided = await pixels(page, { compare: String(share) });
    const line = share * SIZE.width;
    assert.equal(differing(divided, direct, 0, Math.max(0, line - MARGIN)), 0, `left of ${share}`);
    assert.equal(differing(divided, all, Math.min(SIZE.width, line + MARGIN), SIZE.width), 0, `right of ${share}`);
  }
  assert.equal(differing(await pixels(page, {}), all, 0, SIZE.width), 0, 'afterwards all is as it was');
  assert.deepEqual(errors, []);
});

// Each of them does something around every drawing, and either may end first.
test('beside the raking light, whichever ends first, all is as it was', async (t) => {
  const { page, errors } = await open(t);
  const all = await pixels(page, {});
  const lamp = (there) => page.evaluate(async (is) => {
    view.toggleAttribute('raking-light', is);
    while ((view.shadowRoot.querySelector('[role=application]') !== null) !== is) await new Promise((resolve) => setTimeout(resolve, 50));
  }, there);
  // The raking light's coming and going alone leaves what is then the picture: shadows have been drawn anew.
  await lamp(true);
  await lamp(false);
  const again = await pixels(page, {});
  for (const first of ['compare', 'raking-light']) {
    if (first === 'raking-light') await lamp(true);
    await pixels(page, { compare: '0.5' });
    if (first === 'compare') {
      await lamp(true);
      await pixels(page, {});
      await lamp(false);
    } else {
      await lamp(false);
      await pixels(page, { compare: '0.25' });
    }
    assert.equal(differing(await pixels(page, {}), again, 0, SIZE.width), 0, first);
  }
  assert.ok(differing(again, all, 0, SIZE.width) < 0.05 * SIZE.width * SIZE.height, 'edges of shadows alone differ');
  assert.deepEqual(errors, []);
});

test('the visitor moves the line with the pointer and the keys', async (t) => {
  const { page } = await open(t);
  await page.evaluate(() => view.setAttribute('compare', ''));
  const line = page.getByRole('slider');
  await line.waitFor();
  assert.equal(await line.getAttribute('aria-valuenow'), '50');
  const { x, y, width, height } = await line.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(80, 90);
  await page.mouse.up();
  assert.equal(await page.evaluate(() => Number(view.getAttribute('compare'))), 80 / SIZE.width);
  await line.focus();
  await page.keyboard.press('ArrowRight');
  assert.equal(await line.getAttribute('aria-valuenow'), '30');
  for (let i = 0; i < 20; i++) await page.keyboard.press('ArrowLeft');
  assert.equal(await line.getAttribute('aria-valuenow'), '0', 'it stays in the picture');
});

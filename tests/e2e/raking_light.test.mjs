// SPDX-License-Identifier: Apache-2.0
//
// The attribute raking-light: a lamp that the visitor moves.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bakeBall, openBall as open, SIZE } from './ball.mjs';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { temporaryFolder } from './packs.mjs';

/** In pixels from the ball's middle; the ball is 56 pixels wide and high to each side. */
const SIDE = 40;
/** Of 255: a side that is lit is brighter by so much than one that is not. */
const BRIGHTER = 40;

const PACK = bakeBall(temporaryFolder());
const browser = await forAllTests(launch());
const openBall = (t, options) => open(t, browser, PACK, options);

/** Green, of 255, at four places of the ball: right, up, left, down. */
const shades = (page) =>
  page.evaluate(
    ([width, height, side]) => {
      view.draw();
      const picture = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d', { willReadFrequently: true });
      picture.drawImage(view.shadowRoot.querySelector('canvas'), 0, 0, width, height);
      return [[1, 0], [0, -1], [-1, 0], [0, 1]].map(([x, y]) => picture.getImageData(width / 2 + side * x, height / 2 + side * y, 1, 1).data[1]);
    },
    [SIZE.width, SIZE.height, SIDE],
  );

const handle = (page) => page.getByLabel('Lamp');

async function lit(page, value) {
  await page.evaluate((text) => view.setAttribute('raking-light', text), value);
  await handle(page).waitFor();
  return shades(page);
}

test('light grazes the model from where the attribute says, and is gone without it', async (t) => {
  const { page, errors } = await openBall(t);
  const before = await shades(page);
  const [right, , left] = await lit(page, '0deg 10deg');
  assert.ok(right > left + BRIGHTER, `right ${right}, left ${left}`);
  const [, up, , down] = await lit(page, '90deg 10deg');
  assert.ok(up > down + BRIGHTER, `up ${up}, down ${down}`);
  await page.evaluate(() => view.removeAttribute('raking-light'));
  await handle(page).waitFor({ state: 'detached' });
  assert.deepEqual(await shades(page), before);
  assert.deepEqual(errors, []);
});

test('it goes where the camera goes', async (t) => {
  const { page } = await openBall(t);
  await lit(page, '0deg 10deg');
  await page.evaluate(() => (view.view = { ...view.view, theta: Math.PI / 2 }));
  const [right, , left] = await shades(page);
  assert.ok(right > left + BRIGHTER, `right ${right}, left ${left}`);
});

test('the handle moves it, by pointer and by key', async (t) => {
  const { page, view, start } = await openBall(t);
  await lit(page, '0deg 10deg');
  const { x, y, width, height } = await handle(page).boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 2, y + height / 2, { steps: 4 });
  await page.mouse.up();
  const [right, , left] = await shades(page);
  assert.ok(left > right + BRIGHTER, `left ${left}, right ${right}`);
  await handle(page).focus();
  for (let i = 0; i < 40; i++) await page.keyboard.press('ArrowRight');
  const [rightAgain, , leftAgain] = await shades(page);
  assert.ok(rightAgain > leftAgain + BRIGHTER, `right ${rightAgain}, left ${leftAgain}`);
  assert.deepEqual(await view(), start, 'the camera has moved');
});

test('its light casts a shadow', async (t) => {
  const { page } = await openBall(t);
  await lit(page, '0deg 10deg');
  const shadows = await page.evaluate(() => {
    const [lamp] = view.scene.children.filter(({ isDirectionalLight }) => isDirectionalLight);
    view.draw();
    return [lamp.castShadow, lamp.shadow.map !== null];
  });
  assert.deepEqual(shadows, [true, true]);
});

test('without the attribute nothing of it is there', async (t) => {
  const { page } = await openBall(t);
  assert.equal(await handle(page).count(), 0);
  assert.equal(await page.evaluate(() => view.scene.children.length), 1, 'the pack alone');
});

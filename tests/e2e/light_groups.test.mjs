// SPDX-License-Identifier: Apache-2.0
//
// Groups of lamps, switched, dimmed and coloured with their bounced light: a red, a blue and a green one in a grey room. And the sky's
// own light apart from what the ground and a ball reflect of it.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { viewerPage } from './test_page.mjs';
import { complete } from './view.mjs';

const GREY = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.5, 0.5, 0.5, 1] }, extensions: { KHR_materials_specular: { specularFactor: 0 } } };
const STRONG = { KHR_materials_emissive_strength: { emissiveStrength: 8 } };
const GLOBE = { ...GREY, emissiveFactor: [0, 1, 0], extensions: { ...GREY.extensions, ...STRONG } };
/** The channel that each group has alone. */
const CHANNELS = { Red: 0, Blue: 2, Globe: 1 };
/** Two roundings to 8 bits, each at most half a step of sRGB, which is 0.0045 of white where its curve is steepest, and half floats. */
const ROUNDING = 0.012;

const CLIPPED = 0.95;
/** The narrowest that the settings are made for. */
const PHONE = { width: 320, height: 480 };

const folder = temporaryFolder();
const browser = await forAllTests(launch());

function packOf(kind, options) {
  const shapes = [{ mesh: room(1), material: GREY }, { mesh: sphere(0.1), material: GLOBE, at: [0, -0.5, -0.5] }];
  const lamp = (color) => ({ type: 'point', intensity: 1, color });
  const lamps = [{ lamp: lamp([1, 0, 0]), at: [-0.7, 0.5, 0] }, { lamp: lamp([0, 0, 1]), at: [0.7, 0.5, 0] }];
  const file = writeScene(`${folder}/${kind}.gltf`, shapes, lamps);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  ['Room', 'Globe', 'Red.001', 'Blue.001'].forEach((name, i) => (gltf.nodes[i].name = name));
  writeFileSync(file, JSON.stringify(gltf));
  return bake(file, `${folder}/${kind}.lw.glb`, { groups: 'name', ...options });
}

/** A ball over nothing, under a green sky: half of its light comes straight from it. */
function packUnderTheSky() {
  const file = writeScene(`${folder}/ball.gltf`, [{ mesh: sphere(0.5), material: GREY }]);
  return bake(file, `${folder}/ball.lw.glb`, { environment: '0,0.5,0', 'sky-apart': 'always' });
}

const PACKS = { regular: packOf('regular', {}), refined: packOf('refined', { grid: 'auto', budget: '9k' }) };

async function open(t, kind) {
  const server = await forTest(t, startStaticServer({ ...viewerPage('/room.lw.glb'), '/room.lw.glb': PACKS[kind] }));
  const opened = await forTest(t, openPage(browser, { width: 160, height: 120 }));
  await opened.page.goto(server.url);
  await complete(opened.page);
  await opened.page.evaluate(() => document.querySelector('lightwell-view').setAttribute('tone', 'none'));
  await opened.page.evaluate(() => document.querySelector('lightwell-view').setAttribute('exposure', '0'));
  // Pictures are compared: shadows are to stay as they are.
  await opened.page.evaluate(() => document.querySelector('lightwell-view').setAttribute('shadows', 'hard'));
  return opened;
}

/** The picture with some factors, once the grid has them, as light of each pixel's channels. */
const pictureWith = (page, factors, light = 'all') =>
  page
    .evaluate(
      async ([of, part]) => {
        const view = document.querySelector('lightwell-view');
        view.setAttribute('light', part);
        const { texture } = view.pack.grids[0];
        for (const [name, factor] of Object.entries(of)) view.setLightGroup(name, factor);
        while (view.pack.grids[0].texture === texture) await new Promise(requestAnimationFrame);
        // The last of the states that were asked for.
        for (let i = 0; i < 30; i++) await new Promise(requestAnimationFrame);
        view.draw();
        const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
        const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return [...pixels];
      },
      [factors, light],
    )
    .then((bytes) => bytes.map((byte) => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4)));

/** Checks each pixel's channels against what they should be by those of all light; clipped ones say nothing. */
function compare(picture, all, factors, what) {
  picture.forEach((value, i) => {
    if (i % 4 === 3 || all[i] > CLIPPED) return;
    const wanted = factors[i % 4] * all[i];
    assert.ok(Math.abs(value - wanted) < ROUNDING, `${what}, byte ${i}: ${value}, not ${wanted}`);
  });
}

for (const kind of Object.keys(PACKS))
  test(`groups are switched, dimmed and coloured with their bounced light, in a ${kind} grid`, async (t) => {
    const { page, errors } = await open(t, kind);
    assert.deepEqual(await page.evaluate(() => document.querySelector('lightwell-view').pack.lightGroups.sort()), ['Blue', 'Globe', 'Red']);
    const none = { Red: 0, Blue: 0, Globe: 0 };
    for (const part of ['all', 'indirect']) {
      const all = await pictureWith(page, { Red: 1, Blue: 1, Globe: 1 }, part);
      for (const [name, channel] of Object.entries(CHANNELS)) {
        const alone = await pictureWith(page, { ...none, [name]: 1 }, part);
        compare(alone, all, [0, 1, 2].map((c) => Number(c === channel)), `${part} of ${name} alone`);
        assert.ok(alone.filter((value, i) => i % 4 === channel && value > 0.02).length > 300, `${name} shines`);
      }
      const changed = await pictureWith(page, { Red: 0.5, Blue: [0, 0, 0.25], Globe: 0 }, part);
      compare(changed, all, [0.5, 0, 0.25], `${part} dimmed and coloured`);
      compare(await pictureWith(page, none, part), all, [0, 0, 0], `${part} switched off`);
    }
    const said = await page.evaluate(() => {
      try {
        document.querySelector('lightwell-view').setLightGroup('Green', 1);
      } catch ({ message }) {
        return message;
      }
    });
    assert.match(said, /no light group "Green": there are /);
    assert.deepEqual(errors, []);
  });

test('the settings have a slider for each group', async (t) => {
  const { page } = await open(t, 'refined');
  await page.setViewportSize(PHONE);
  await page.evaluate(() => (document.querySelector('#panel').open = true));
  await page.getByText('Settings').click();
  const slider = page.getByLabel(/^Blue/);
  await slider.waitFor();
  await slider.fill('0');
  const blue = await page.evaluate(() => {
    const { lamps } = document.querySelector('lightwell-view').pack;
    return lamps.filter(({ color }) => color.b > 0).length;
  });
  assert.equal(blue, 0);
  await page.getByLabel('Colour of Red').fill('#808080');
  const red = await page.evaluate(() => {
    const { lamps } = document.querySelector('lightwell-view').pack;
    return Math.max(...lamps.map(({ color }) => color.r));
  });
  assert.ok(Math.abs(red - 0.216) < 0.001, `${red}: half of the code in sRGB is 0.216 of the light`);
});

test('the sky’s own light is dimmed apart from what surfaces reflect', async (t) => {
  const server = await forTest(t, startStaticServer({ ...viewerPage('/ball.lw.glb'), '/ball.lw.glb': packUnderTheSky() }));
  const { page, errors } = await forTest(t, openPage(browser, { width: 160, height: 120 }));
  await page.goto(server.url);
  await complete(page);
  await page.setViewportSize(PHONE);
  await page.evaluate(() => (document.querySelector('#panel').open = true));
  await page.getByText('Settings').click();
  const slider = page.getByLabel(/^The sky/);
  await slider.waitFor();
  const brightness = async (factor) => {
    const { width } = await slider.boundingBox();
    assert.ok(width > 40, `the slider is ${width} pixels wide`);
    return page.evaluate(async (of) => {
      const view = document.querySelector('lightwell-view');
      view.setAttribute('tone', 'none');
      view.setAttribute('shadows', 'hard');
      const { newest } = view.pack.grids[0];
      const input = [...document.querySelectorAll('#groups input')].find(({ type }) => type === 'range');
      input.value = of;
      input.dispatchEvent(new Event('input'));
      while (view.pack.grids[0].newest === newest) await new Promise(requestAnimationFrame);
      view.draw();
      const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
      const pixel = new Uint8Array(4);
      gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      return pixel[1];
    }, factor);
  };
  const [all, half, none] = [await brightness(1), await brightness(0.5), await brightness(0)];
  assert.ok(all > half && half > none, `${all}, ${half}, ${none}`);
  assert.ok(none < all / 4, 'a ball by itself reflects next to nothing onto itself');
  assert.match(await page.evaluate(() => {
    try {
      document.querySelector('lightwell-view').pack.setSkyLight(-1);
    } catch ({ message }) {
      return message;
    }
  }), /no number or three of at least 0/);
  assert.equal(await page.evaluate(() => document.querySelector('lightwell-view').pack.lightGroups.length), 0);
  assert.deepEqual(errors, []);
});

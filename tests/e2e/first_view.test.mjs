// SPDX-License-Identifier: Apache-2.0
//
// What a visitor sees first of a thing whose file has no camera.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch } from './browser.mjs';
import { forAllTests } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { openScript } from './test_page.mjs';
import { complete } from './view.mjs';

const folder = temporaryFolder();
const browser = await forAllTests(launch());
const MATT = { pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [0.6, 0.6, 0.6, 1] } };

/** A ball, or one stretched along an axis. */
function packOf(name, stretch) {
  const ball = sphere(0.5, 24);
  const mesh = { ...ball, positions: ball.positions.map((x, i) => x * stretch[i % 3]) };
  return bake(writeScene(`${folder}/${name}.gltf`, [{ mesh, material: MATT }]), `${folder}/${name}.lw.glb`, { environment: '1,1,1' });
}

/** The box of what is seen, as parts of the picture's sides. */
const seen = (page) =>
  page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    view.draw();
    const gl = view.shadowRoot.querySelector('canvas').getContext('webgl2');
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let [left, right, bottom, top] = [width, 0, height, 0];
    for (let y = 0; y < height; y++)
      for (let x = 0; x < width; x++)
        if (pixels[4 * (y * width + x) + 3] > 0) [left, right, bottom, top] = [Math.min(left, x), Math.max(right, x + 1), Math.min(bottom, y), Math.max(top, y + 1)];
    return { left: left / width, right: right / width, bottom: bottom / height, top: top / height };
  });

/** An overview leaves a tenth free; the box of what is round is larger than that. */
const FILLED = 0.7;

for (const [name, stretch, size, side] of [
  ['tall', [1, 4, 1], [200, 400], 'height'],
  ['wide', [4, 1, 1], [200, 400], 'width'],
  ['tall', [1, 4, 1], [400, 200], 'height'],
])
  test(`a ${name} thing fills the ${side} of a canvas of ${size}, and no more`, async (t) => {
    const { page, errors } = await openScript(t, browser, 'tests/e2e/pages/element.ts', { '/pack.lw.glb': packOf(name, stretch) });
    await page.evaluate(([width, height]) => {
      document.body.innerHTML = `<lightwell-view src="pack.lw.glb" style="width: ${width}px; height: ${height}px"></lightwell-view>`;
    }, size);
    await complete(page);
    const { left, right, bottom, top } = await seen(page);
    const [across, up] = [right - left, top - bottom];
    assert.ok(left > 0 && right < 1 && bottom > 0 && top < 1, `it is cut: ${[left, right, bottom, top]}`);
    assert.ok((side === 'height' ? up : across) > FILLED, `${across} x ${up}`);
    assert.deepEqual(errors, []);
  });

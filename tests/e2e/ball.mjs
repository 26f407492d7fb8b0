// SPDX-License-Identifier: Apache-2.0
//
// An element that shows a ball of one metre around the origin and fills its page; the camera looks at it along -z.
import { readFileSync, writeFileSync } from 'node:fs';
import { openPage } from './browser.mjs';
import { forTest } from './lifetime.mjs';
import { bake } from './packs.mjs';
import { sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** From the camera to the ball's middle, in metres. */
export const FAR = 4;
export const SIZE = { width: 320, height: 180 };
/** The ball has facets, its coordinates are rounded, and a pixel is 15 mm there; metres. */
export const NEAR = 0.03;

/** Its file has a camera, too: "From above", at some place over the ball. */
export const ABOVE = [0, 3, 0];

export function bakeBall(folder) {
  const material = { pbrMetallicRoughness: { metallicFactor: 0 } };
  const file = writeScene(`${folder}/ball.gltf`, [{ mesh: sphere(1, 48), material }], [{ lamp: { type: 'directional', intensity: 3 }, at: [0, 0, 5] }]);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: Math.PI / 4, znear: 0.1 } }];
  const rotation = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];
  gltf.scenes[0].nodes.push(gltf.nodes.push({ name: 'From above', camera: 0, translation: ABOVE, rotation }) - 1);
  writeFileSync(file, JSON.stringify(gltf));
  return bake(file, `${folder}/ball.lw.glb`);
}

/** Opens the page; in it `view` is the element, once all has come. */
export async function openBall(t, browser, pack, { attributes = 'camera-controls', children = '', after = '', reducedMotion = 'no-preference', ...options } = {}) {
  const body = `<lightwell-view src="ball.lw.glb" ${attributes} camera-orbit="0deg 90deg ${FAR}m" camera-target="0m 0m 0m" field-of-view="45deg"
    style="position: absolute; inset: 0">${children}</lightwell-view>${after}`;
  const server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/ball.lw.glb': pack }));
  const { page, errors } = await forTest(t, openPage(browser, { ...SIZE, ...options }));
  await page.emulateMedia({ reducedMotion });
  await page.goto(server.url);
  await complete(page);
  const start = await page.evaluate(() => (globalThis.view = document.querySelector('lightwell-view')).view);
  return { page, errors, start, view: () => page.evaluate(() => globalThis.view.view) };
}

/** The place in the window so many pixels right of the middle. */
export const at = (pixels) => [SIZE.width / 2 + pixels, SIZE.height / 2];

/** Where the ray through it meets the ball, and how far from the camera. */
export function meets(pixels) {
  const slope = (pixels / (SIZE.height / 2)) * Math.tan(Math.PI / 8);
  // (z slope)^2 + (FAR - z)^2 = 1, z from the camera on
  const [a, b, c] = [slope ** 2 + 1, -2 * FAR, FAR ** 2 - 1];
  const z = (-b - Math.sqrt(b ** 2 - 4 * a * c)) / (2 * a);
  return { point: [z * slope, 0, FAR - z], distance: z * Math.hypot(slope, 1) };
}

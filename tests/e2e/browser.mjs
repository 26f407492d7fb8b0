// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { chromium } from './dependencies.mjs';

/** Two renderers on the processor: Mesa's, and ANGLE's own, which knows other extensions. */
export const LLVMPIPE = { name: 'llvmpipe', arguments: ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist'] };
export const SWIFTSHADER = { name: 'SwiftShader', arguments: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'] };
export const PATIENCE = 60_000;

/** Debian's Chromium; a wrong flag would silently give another renderer, so its name is checked. */
export async function launch(renderer = LLVMPIPE) {
  const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: renderer.arguments });
  const page = await browser.newPage();
  const name = await page.evaluate(() => {
    const gl = document.createElement('canvas').getContext('webgl2');
    return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
  });
  await page.close();
  assert.ok(name.includes(renderer.name), name);
  return browser;
}

/**
 * A page of 320 x 180. `errors` collects what its console calls an error, but for connections that were lost or refused, which
 * the browser reports there and which tests provoke.
 */
export async function openPage(browser, { width = 320, height = 180, hasTouch = false, isMobile = false, init = undefined } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, deviceScaleFactor: 1, hasTouch, isMobile });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  const errors = [];
  page.on('console', (message) => {
    if (message.type() === 'error' && !/net::ERR_|Failed to load resource/.test(message.text())) errors.push(message.text());
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  if (init !== undefined) await page.addInitScript(init);
  return { page, errors, close: () => context.close() };
}

// SPDX-License-Identifier: Apache-2.0
//
// Bakes three.js's light grid in Chromium on llvmpipe.
import { readFileSync } from 'node:fs';
import { launch, openPage } from '../../tests/e2e/browser.mjs';
import { ROOT, WEB } from '../../tests/e2e/dependencies.mjs';
import { startStaticServer } from '../../tests/e2e/static_server.mjs';
import { unpackAtlas } from './grid.mjs';

const THREE = `${WEB}node_modules/three/`;
const GRID_MODULE = 'examples/jsm/lighting/LightProbeGridWebGL.js';
const IMPORTS = { three: '/three/build/three.module.js', 'three/addons/': '/three/examples/jsm/' };
const HTML = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
  <script type="importmap">${JSON.stringify({ imports: IMPORTS })}</script><script type="module" src="page.js"></script>`;

/** Rows that a texture has at most, on llvmpipe as on most GPUs. */
const ROWS = 16_384;
/**
 * The bake keeps a row of nine texels a node; where the GPU has not that many rows, every value is 0 and nothing throws. Folded,
 * the rows go on in the next nine columns.
 */
const FOLDED = [
  ['RenderTarget( 9, totalProbes,', `RenderTarget( 9 * Math.ceil( totalProbes / ${ROWS} ), Math.min( totalProbes, ${ROWS} ),`],
  ['set( 0, batchRow, 9, 1 )', `set( 9 * Math.floor( batchRow / ${ROWS} ), batchRow % ${ROWS}, 9, 1 )`],
  ['coefIndex = int( gl_FragCoord.x )', 'coefIndex = int( gl_FragCoord.x ) % 9'],
  ...Array.from({ length: 9 }, (_, i) => [
    `ivec2( ${i}, probeIndex )`,
    `ivec2( ${i} + 9 * ( probeIndex / ${ROWS} ), probeIndex % ${ROWS} )`,
  ]),
];

/** three.js's module of the grid, changed only where there are too many nodes for it. */
function gridModule(nodes) {
  let text = readFileSync(THREE + GRID_MODULE, 'utf8');
  if (nodes ** 3 <= ROWS) return text;
  for (const [found, replacement] of FOLDED) {
    if (text.split(found).length !== 2) throw new Error(`${GRID_MODULE}: '${found}' is not there once: another release?`);
    text = text.replace(found, replacement);
  }
  return text;
}

/** Seconds for which all of Chromium has kept processors busy. */
async function processorSeconds(session) {
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  return processInfo.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

/** The grid after each pass, and for how many seconds all of them kept processors busy; `scene` is as page.js takes it. */
export async function bakeInChromium(scene, passes) {
  const server = await startStaticServer({
    '/': { text: HTML, type: 'text/html' },
    '/page.js': `${ROOT}bench/peer_three/page.js`,
    '/three/': THREE,
    [`/three/${GRID_MODULE}`]: { text: gridModule(scene.nodes), type: 'text/javascript' },
  });
  const browser = await launch();
  try {
    const { page, errors } = await openPage(browser);
    await page.goto(server.url);
    await page.waitForFunction(() => globalThis.prepare !== undefined);
    await page.evaluate((given) => globalThis.prepare(given), scene);
    const session = await browser.newBrowserCDPSession();
    const start = await processorSeconds(session);
    const grids = [];
    for (let pass = 0; pass < passes; pass++) {
      const atlas = await page.evaluate((number) => globalThis.bakePass(number), pass);
      grids.push(unpackAtlas(atlas, scene.nodes));
    }
    const seconds = (await processorSeconds(session)) - start;
    if (errors.length > 0) throw new Error(errors.join('\n'));
    return { grids, seconds };
  } finally {
    await browser.close();
    await server.close();
  }
}

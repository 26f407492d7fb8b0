// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { ROOT, three } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { startStaticServer } from './static_server.mjs';
import { scriptPage } from './test_page.mjs';

/** llvmpipe filters 3D textures with weights of 8 bits: 0.6 % of the largest corner were measured, over 28 channels. */
const TOLERANCE = 0.015;
/** Of the chunks of three.js 0.187 that Lightwell's shaders replace or extend. */
const STOCK_CHUNKS = {
  lightprobes_pars_fragment: '6649a855ba224cdc',
  lights_fragment_begin: 'c34bf35489252822',
  lights_fragment_maps: 'b36fa0d94fd78dc3',
};

const browser = await forAllTests(launch());

test('the chunks of three.js are those that the lookup was written for', () => {
  for (const [name, expected] of Object.entries(STOCK_CHUNKS)) {
    const hash = createHash('sha256').update(three.ShaderChunk[name]).digest('hex').slice(0, 16);
    assert.equal(hash, expected, `three.js changed ${name}: look again at shaders/ before accepting it`);
  }
});

const GRIDS = { regular: 0, divided: 1 };
const LOOKUPS = { trilinear: 'irradiance', tricubic: 'tricubic' };

for (const [kind, number] of Object.entries(GRIDS)) for (const [lookup, wanted] of Object.entries(LOOKUPS))
test(`a material receives the ${lookup} irradiance that light/ computes of a ${kind} grid, wherever it stands`, async (t) => {
  const fixture = JSON.parse(await readFile(`${ROOT}tests/data/light/lookup.json`, 'utf8'))[number];
  const server = await forTest(t, startStaticServer(await scriptPage('tests/e2e/pages/lookup.ts')));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.run !== undefined);
  const measured = await page.evaluate((input) => globalThis.run(...input), [fixture, lookup]);
  fixture.placements.forEach(({ samples }, place) =>
    samples.forEach(({ [wanted]: irradiance, point }, i) => {
      const largest = Math.max(...irradiance);
      irradiance.forEach((expected, channel) => {
        const difference = Math.abs(measured[place][i][channel] - expected);
        assert.ok(difference <= TOLERANCE * largest, `placement ${place}, point ${point}: ${measured[place][i]}, not ${irradiance}`);
      });
    }),
  );
  const shader = await page.evaluate(() => globalThis.fragmentShader());
  const count = (pattern) => shader.match(pattern)?.length ?? 0;
  assert.equal(count(/\btexture(Lod|Grad|Offset)?\(\s*probesSH\b/g), 7, 'the lookup is seven filtered fetches');
  assert.equal(count(/\bfetchLightProbes\(/g), 3, 'defined, and called once in each lookup');
  assert.equal(count(/irradiance \+= getLightProbeGridIrradiance\(/g), 1, 'called once for the one grid');
  assert.deepEqual(errors, []);
});

test('a grid of three.js’s own lights as before', async (t) => {
  const server = await forTest(t, startStaticServer(await scriptPage('tests/e2e/pages/stock_grid.ts')));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.run !== undefined);
  const { stock, patched } = await page.evaluate(() => globalThis.run());
  const lit = stock.filter((value, i) => i % 4 < 3 && value > 0.01).length;
  assert.ok(lit > 1000, `only ${lit} values are lit`);
  const largest = Math.max(...stock);
  stock.forEach((expected, i) => {
    assert.ok(Math.abs(patched[i] - expected) <= TOLERANCE * largest, `value ${i}: ${patched[i]}, not ${expected}`);
  });
  assert.deepEqual(errors, []);
});

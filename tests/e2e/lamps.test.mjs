// SPDX-License-Identifier: Apache-2.0
//
// Many lamps and materials of many maps, on a GPU with the 16 texture units that WebGL2 promises.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { startServe } from './servers.mjs';
import { complete } from './view.mjs';

const UNITS = 16;
/** Lamps that the page lights by itself; the others are in the grid. */
const MOST_LAMPS = 16;
/** That a lit standard material reads besides its maps: the lamps, the light grid and the table of its BRDF. */
const OWN_UNITS = 3;

/** Runs in a page before its scripts: 16 texture units; `programs` keeps all that is linked. */
const SIXTEEN_UNITS = `{
  globalThis.programs = [];
  const prototype = WebGL2RenderingContext.prototype;
  const { getParameter, linkProgram } = prototype;
  prototype.getParameter = function (parameter) {
    return parameter === prototype.MAX_TEXTURE_IMAGE_UNITS ? ${UNITS} : getParameter.call(this, parameter);
  };
  prototype.linkProgram = function (program) { programs.push([this, program]); return linkProgram.call(this, program); };
}`;
/** The most texture units that a program of the page reads. */
const mostUnits = () =>
  Math.max(
    ...globalThis.programs.map(([gl, program]) => {
      let units = 0;
      for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
        const { type, size } = gl.getActiveUniform(program, i);
        if (/^sampler/.test(NAMES[type])) units += size;
      }
      return units;
    }),
  );
/** The names of WebGL's types of uniforms. */
const NAME_TYPES = `globalThis.NAMES = {};
for (const name of ['SAMPLER_2D', 'SAMPLER_3D', 'SAMPLER_CUBE', 'SAMPLER_2D_SHADOW', 'SAMPLER_CUBE_SHADOW', 'SAMPLER_2D_ARRAY'])
  NAMES[WebGL2RenderingContext[name]] = name.toLowerCase();`;

const GREY = { index: 0 };
/** Five maps. */
const MAPS = {
  pbrMetallicRoughness: { baseColorTexture: GREY, metallicRoughnessTexture: GREY },
  normalTexture: GREY,
  occlusionTexture: GREY,
  emissiveTexture: GREY,
};
/** Eleven. */
const MANY_MAPS = {
  ...MAPS,
  extensions: {
    KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatTexture: GREY, clearcoatRoughnessTexture: GREY, clearcoatNormalTexture: GREY },
    KHR_materials_sheen: { sheenColorFactor: [1, 1, 1], sheenColorTexture: GREY, sheenRoughnessTexture: GREY },
    KHR_materials_specular: { specularTexture: GREY },
  },
};
const DOWN = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];

/** Lamps of all kinds below the ceiling. */
function lampsOf(count) {
  return Array.from({ length: count }, (_, i) => ({
    lamp: { type: ['spot', 'point', 'spot', 'directional'][i % 4], intensity: 1 + i / 10, color: [1, (i % 3) / 2, (i % 5) / 4] },
    at: [Math.cos(i), 0.8, Math.sin(i)],
    rotation: DOWN,
  }));
}

const folder = temporaryFolder();
const browser = await forAllTests(launch());

async function open(t, name, material, lamps) {
  const shapes = [{ mesh: room(1.5), material: MAPS }, { mesh: sphere(0.4, 12), material }];
  const pack = bake(writeScene(`${folder}/${name}.gltf`, shapes, lampsOf(lamps)), `${folder}/${name}.lw.glb`);
  const server = await forTest(t, startServe(pack));
  const { page, errors } = await forTest(t, openPage(browser, { init: SIXTEEN_UNITS + NAME_TYPES }));
  const warnings = [];
  page.on('console', (message) => message.type() === 'warning' && warnings.push(message.text()));
  await page.goto(server.url);
  await complete(page);
  const shining = await page.evaluate(() => document.querySelector('lightwell-view').pack.lamps.length);
  assert.deepEqual(errors, []);
  assert.deepEqual(warnings.filter((text) => /texture unit/.test(text)), []);
  return { lamps: shining, units: await page.evaluate(mostUnits), page };
}

test('four lamps cost materials of five maps one texture unit', async (t) => {
  const { lamps, units } = await open(t, 'four', MAPS, 4);
  assert.equal(lamps, 4);
  // Metalness and roughness are one map of the file and two of three.js's.
  assert.ok(units <= 6 + OWN_UNITS, `${units} texture units`);
});

test('of many lamps the strongest are lit, and leave room for eleven maps', async (t) => {
  const { lamps, units, page } = await open(t, 'many', MANY_MAPS, 18);
  assert.equal(lamps, MOST_LAMPS);
  assert.ok(units > 11 && units <= UNITS, `${units} texture units`);
  const contains = await page.evaluate(() => document.querySelector('lightwell-view').pack.grids[0].definition.contains);
  assert.ok(contains.length > 1, `the grid holds ${contains}`);
});

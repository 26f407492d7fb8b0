// SPDX-License-Identifier: Apache-2.0
//
// The light that `lightwell export --light` writes for three.js and for Bevy, read as they read it, says at its nodes what
// `lightwell probe` says there.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { three, WEB } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { room, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { scriptPage } from './test_page.mjs';

/** Khronos' KTX2 as Don McCurdy's ktx-parse reads it, which three.js brings along. */
const { read } = await import(`${WEB}node_modules/three/examples/jsm/libs/ktx-parse.module.js`);
const VK_FORMAT_R16G16B16A16_SFLOAT = 97;

const AXES = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
const OBLIQUE = [[0.6, 0.8, 0], [-0.48, 0.6, 0.64], [0.36, -0.48, -0.8]];

const folder = temporaryFolder();
const browser = await forAllTests(launch());
const regular = bake('box-small', `${folder}/regular.lw.glb`);
const adaptive = bakeAdaptive(`${folder}/adaptive.lw.glb`);

/** A room whose light changes quickly beside a lamp, so that some cells are finer. */
function bakeAdaptive(file) {
  const lamp = { type: 'point', intensity: 1, color: [1, 0.5, 0.2] };
  const white = { pbrMetallicRoughness: { baseColorFactor: [0.8, 0.8, 0.8, 1], metallicFactor: 0 } };
  const scene = writeScene(`${folder}/room.gltf`, [{ mesh: room(1), material: white }], [{ lamp, at: [-0.8, 0.7, 0.2] }]);
  const options = ['bake', scene, '-o', file, '--budget', '9k', '--quiet', '--json'];
  const { nodes } = JSON.parse(execFileSync(`${BIN}/lightwell`, options, { encoding: 'utf8' }));
  const [{ nodes: coarse }] = gridsOf(file);
  assert.ok(nodes > coarse[0] * coarse[1] * coarse[2], 'the grid has bricks');
  return file;
}

/** Exports a pack's light; gives the file's path and where its cells lie. */
function exportLight(pack, ending, ...options) {
  const file = `${pack}.${ending}`;
  const figures = execFileSync(`${BIN}/lightwell`, ['export', pack, '--light', file, '--json', ...options], { encoding: 'utf8' });
  const { nodes, center, size } = Object.fromEntries(Object.entries(JSON.parse(figures)).map(([name, { x, y, z }]) => [name, [x, y, z]]));
  const cell = size.map((length, axis) => length / nodes[axis]);
  return { file, nodes, cell, place: (node) => node.map((i, axis) => center[axis] - size[axis] / 2 + (i + 0.5) * cell[axis]) };
}

/** Some nodes of a grid, among them its corners. */
function* someNodes([nx, ny, nz]) {
  for (const x of [0, nx >> 1, nx - 1]) for (const y of [0, ny >> 1, ny - 1]) for (const z of [0, nz >> 1, nz - 1]) yield [x, y, z];
}

/** Nodes with a direction each; `place` says where. */
const questions = ({ nodes, place }, directions) =>
  [...someNodes(nodes)].flatMap((node) => directions.map((direction) => ({ node, at: place(node), direction })));

/** The irradiance that `lightwell probe` finds in the pack's light; its lookup goes off the point, along the normal. */
function probed(pack, asked) {
  const { normalOffset, cell } = gridsOf(pack).reduce((first, grid) => (grid.priority > first.priority ? grid : first));
  const rows = asked.map(({ at, direction }) => [...at.map((x, axis) => x - normalOffset * cell[axis] * direction[axis]), ...direction]);
  writeFileSync(`${folder}/points.csv`, ['x,y,z,nx,ny,nz', ...rows.map((row) => row.join(','))].join('\n'));
  const options = ['--points', `${folder}/points.csv`, '--integrator', 'ivg', '--quantity', 'indirect', '--json', '--quiet'];
  return JSON.parse(execFileSync(`${BIN}/lightwell`, ['probe', pack, ...options], { encoding: 'utf8' })).points.map(({ rgb }) => rgb);
}

/** The grids of a pack as its JSON describes them. */
function gridsOf(pack) {
  const bytes = readFileSync(pack);
  const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
  return json.extensions.LIGHTWELL_light_grids.grids;
}

function assertNear(found, expected, tolerance, asked) {
  assert.ok(Math.max(...expected.flat()) > 0.1, 'there is light');
  found.forEach((colour, i) => colour.forEach((value, channel) => {
    const difference = Math.abs(value - expected[i][channel]);
    assert.ok(difference <= tolerance(expected[i]), `${JSON.stringify(asked[i])}: ${colour}, not ${expected[i]}`);
  }));
}

/** Irradiance of nine coefficients by three.js's formula (its shader chunk lightprobes_pars_fragment). */
function irradianceOf(coefficients, [x, y, z]) {
  const [first, second] = [2 * 0.511664, 2 * 0.429043];
  const weights = [
    0.886227, first * y, first * z, first * x, second * x * y, second * y * z, 0.743125 * z * z - 0.247708, second * x * z,
    (second / 2) * (x * x - y * y),
  ];
  return [0, 1, 2].map((channel) => Math.max(0, weights.reduce((sum, weight, i) => sum + weight * coefficients[3 * i + channel], 0)));
}

/**
 * Of the adaptive grid: its own nodes are at other places, but for the outermost. Next to a node inside of a wall the light changes
 * within 2^-13 of a cell, which is less than what the way through CSV rounds.
 */
const NODES = '8';

/** Nine weights of 1.1 at most, each with half of a 4096th. */
const ROUNDING = (9 * 1.1 * 0.5) / 4096;

for (const [name, pack, options] of [['regular', regular, []], ['adaptive', adaptive, ['--grid', NODES]]])
  test(`a light probe grid of a ${name} grid has its light`, () => {
    const exported = exportLight(pack, 'json', ...options);
    const { resolution, coefficients: { scale, data } } = JSON.parse(readFileSync(exported.file, 'utf8'));
    assert.deepEqual(resolution, exported.nodes);
    assert.equal(data.length, 27 * resolution[0] * resolution[1] * resolution[2]);
    const asked = questions(exported, [...AXES, ...OBLIQUE]);
    const found = asked.map(({ node: [x, y, z], direction }) => {
      const first = 27 * (x + resolution[0] * (y + resolution[1] * z));
      return irradianceOf(data.slice(first, first + 27).map((value) => value / scale), direction);
    });
    // The constants of the formula have six digits.
    assertNear(found, probed(pack, asked), (colour) => ROUNDING + 1e-5 * Math.max(...colour), asked);
  });

for (const [name, pack, options] of [['regular', regular, []], ['adaptive', adaptive, ['--grid', NODES]]])
  test(`an irradiance volume of a ${name} grid has its light`, () => {
    const exported = exportLight(pack, 'ktx2', ...options);
    const container = read(new Uint8Array(readFileSync(exported.file)));
    const [nx, ny, nz] = exported.nodes;
    assert.equal(container.vkFormat, VK_FORMAT_R16G16B16A16_SFLOAT);
    assert.deepEqual([container.pixelWidth, container.pixelHeight, container.pixelDepth], [nx, 2 * ny, 3 * nz]);
    const { buffer, byteOffset, byteLength } = container.levels[0].levelData;
    const halves = new Uint16Array(buffer.slice(byteOffset, byteOffset + byteLength));
    assert.equal(halves.length, 4 * 6 * nx * ny * nz);
    const asked = questions(exported, AXES);
    // As irradiance_volume.wgsl finds the texel of a side: the axis along z, negative ones in the second half along y.
    const found = asked.map(({ node: [x, y, z], direction }) => {
      const axis = direction.findIndex((part) => part !== 0);
      const row = y + (direction[axis] < 0 ? ny : 0);
      const texel = 4 * (x + nx * (row + 2 * ny * (z + nz * axis)));
      return [0, 1, 2].map((channel) => Math.PI * three.DataUtils.fromHalfFloat(halves[texel + channel]));
    });
    // Half of a half's last digit, and the smallest halves of dark nodes.
    assertNear(found, probed(pack, asked), (colour) => 2 ** -11 * Math.max(...colour) + 1e-6, asked);
  });

test('three.js lights with an exported grid', async (t) => {
  const exported = exportLight(regular, 'json');
  const server = await forTest(t, startStaticServer(await scriptPage('tests/e2e/pages/exported_grid.ts')));
  const { page, errors } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.run !== undefined);
  const asked = questions(exported, [...AXES, ...OBLIQUE]);
  // three.js looks up half a cell in front of the surface.
  const points = asked.map(({ at, direction }) => ({
    position: at.map((x, axis) => x - 0.5 * exported.cell[axis] * direction[axis]),
    normal: direction,
  }));
  const found = await page.evaluate((input) => globalThis.run(...input), [JSON.parse(readFileSync(exported.file, 'utf8')), points]);
  // llvmpipe filters 3D textures with weights of 8 bits: 0.6 % of the largest were measured, over 28 channels.
  assertNear(found, probed(regular, asked), (colour) => 0.015 * Math.max(...colour) + ROUNDING, asked);
  assert.deepEqual(errors, []);
});

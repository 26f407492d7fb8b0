// SPDX-License-Identifier: Apache-2.0
//
// What stands far away, is bent by a skin or a morph target, is hidden, unlit or turned by Exif data looks on the page as in `lightwell
// render`: one by one, and all at once.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { bake, BIN, temporaryFolder } from './packs.mjs';
import { room, sphere, writeScene } from './scenes.mjs';
import { startStaticServer } from './static_server.mjs';
import { CLIENT, scriptPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** CIEDE2000; 1 is just visible. What remains is the noise of `render` and 8-bit colours. */
const MEAN = 0.5;
const P95 = 1.5;
const SIZE = [320, 180];

const folder = temporaryFolder();
const lightwell = (...options) => execFileSync(`${BIN}/lightwell`, [...options, '--quiet'], { encoding: 'utf8' });
const browser = await forAllTests(launch());

// The page shows it without gloss.
const diffuse = (...color) => ({
  pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: [...color, 1] },
  extensions: { KHR_materials_specular: { specularFactor: 0 } },
});
const SHAPES = [
  { mesh: room(1), material: diffuse(0.7, 0.7, 0.7) },
  { mesh: sphere(0.25), material: diffuse(0.8, 0.2, 0.2), at: [-0.4, -0.4, -0.3] },
];
const LAMPS = [{ lamp: { type: 'point', intensity: 0.5 }, at: [0.3, 0.5, 0.4] }];

/** Appends an accessor of floats (or bytes) to a document of one data URI. */
function accessor(gltf, array, type, components) {
  const [prefix, old] = gltf.buffers[0].uri.split(',');
  const before = Buffer.from(old, 'base64');
  gltf.buffers[0].uri = `${prefix},${Buffer.concat([before, Buffer.from(array.buffer)]).toString('base64')}`;
  gltf.buffers[0].byteLength = before.length + array.byteLength;
  const view = gltf.bufferViews.push({ buffer: 0, byteOffset: before.length, byteLength: array.byteLength }) - 1;
  const componentType = array instanceof Float32Array ? 5126 : 5121;
  return gltf.accessors.push({ bufferView: view, componentType, count: array.length / components, type }) - 1;
}

/** A JPEG that is dark below and red at its left, whose Exif data say that it is to be turned by a quarter. */
async function turnedPicture() {
  const { page, close } = await openPage(browser);
  const url = await page.evaluate(() => {
    const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 64 });
    const context = canvas.getContext('2d');
    for (const [x, y, from, to] of [[64, 0, 'red', 'white'], [0, 64, 'transparent', 'black']]) {
      context.fillStyle = context.createLinearGradient(0, 0, x, y);
      context.fillStyle.addColorStop(0, from);
      context.fillStyle.addColorStop(1, to);
      context.fillRect(0, 0, 64, 64);
    }
    return canvas.toDataURL('image/jpeg', 0.95);
  });
  await close();
  const jpeg = Buffer.from(url.split(',')[1], 'base64');
  // A TIFF directory of one entry: the orientation (274), a 16-bit number, is 6.
  const tiff = [77, 77, 0, 42, 0, 0, 0, 8, 0, 1, 274 >> 8, 274 & 255, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0, 0, 0, 0, 0];
  const exif = Buffer.from([255, 0xe1, 0, 8 + tiff.length, ...Buffer.from('Exif\0\0'), ...tiff]);
  return `data:image/jpeg;base64,${Buffer.concat([jpeg.subarray(0, 2), exif, jpeg.subarray(2)]).toString('base64')}`;
}

const TURNED = await turnedPicture();

/** What each scene does to the room with its ball, node 1. */
const SCENES = {
  'a scene far away': (gltf) => {
    const children = gltf.scenes[0].nodes;
    gltf.scenes[0].nodes = [gltf.nodes.push({ children, translation: [4e6, 3e6, 13e6] }) - 1];
  },
  'a skin in its pose': (gltf) => {
    // A joint that stretches would turn normals differently: three.js leaves out the inverse transpose.
    const joints = [
      { translation: [0.3, 0.1, -0.3], rotation: [0, 0, 0.6, 0.8], scale: [1.3, 1.3, 1.3] },
      { translation: [0.1, 0.1, -0.2], rotation: [0, 0, 0.6, 0.8], scale: [1.3, 1.3, 1.3] },
    ].map((node) => gltf.nodes.push(node) - 1);
    gltf.scenes[0].nodes.push(...joints);
    gltf.skins = [{ joints }];
    gltf.nodes[1].skin = 0;
    const { attributes } = gltf.meshes[1].primitives[0];
    const { count } = gltf.accessors[attributes.POSITION];
    attributes.JOINTS_0 = accessor(gltf, Uint8Array.from({ length: 4 * count }, (_, i) => (i % 4 === 1 ? 1 : 0)), 'VEC4', 4);
    // From the first joint at the ball's one pole, where its vertices begin, to the second at the other.
    const along = (i) => Math.floor(i / 4) / (count - 1);
    const weights = Array.from({ length: 4 * count }, (_, i) => [1 - along(i), along(i), 0, 0][i % 4]);
    attributes.WEIGHTS_0 = accessor(gltf, Float32Array.from(weights), 'VEC4', 4);
  },
  'a morph target at its weight': (gltf) => {
    const { attributes, ...primitive } = gltf.meshes[1].primitives[0];
    const { count } = gltf.accessors[attributes.POSITION];
    // As it moves it grows taller towards the pole at which its vertices begin.
    const moved = Array.from({ length: 3 * count }, (_, i) => [0.6, 0.2 + 0.3 * (1 - Math.floor(i / 3) / (count - 1)), 0][i % 3]);
    const target = accessor(gltf, Float32Array.from(moved), 'VEC3', 3);
    const f32 = Math.fround;
    Object.assign(gltf.accessors[target], { min: [f32(0.6), f32(0.2), 0], max: [f32(0.6), f32(0.5), 0] });
    const other = accessor(gltf, new Float32Array(3 * count).fill(0.25), 'VEC3', 3);  // of no weight
    Object.assign(gltf.accessors[other], { min: [0.25, 0.25, 0.25], max: [0.25, 0.25, 0.25] });
    const targets = [{ POSITION: target }, { POSITION: other }];
    gltf.meshes[1] = { primitives: [{ attributes, ...primitive, targets }], weights: [0.5, 0] };
  },
  'a hidden node': (gltf) => {
    gltf.extensionsUsed.push('KHR_node_visibility');
    gltf.nodes[1].extensions = { KHR_node_visibility: { visible: false } };
  },
  'an unlit ball': (gltf) => {
    gltf.extensionsUsed.push('KHR_materials_unlit');
    const unlit = { pbrMetallicRoughness: { baseColorFactor: [0.2, 0.4, 0.8, 1] }, extensions: { KHR_materials_unlit: {} } };
    gltf.meshes[1].primitives[0].material = gltf.materials.push(unlit) - 1;
  },
  'a picture whose Exif data turn it': (gltf) => {
    gltf.images[0].uri = TURNED;
    gltf.materials[0].pbrMetallicRoughness.baseColorTexture = { index: 0 };
  },
  'a scene of all of these': (gltf) => {
    const [attributes] = gltf.meshes[1].primitives.map((primitive) => primitive.attributes);
    const ball = (material, at) => {
      const mesh = gltf.meshes.push({ primitives: [{ ...gltf.meshes[1].primitives[0], attributes: { ...attributes }, material }] }) - 1;
      const node = gltf.nodes.push({ mesh, translation: at, scale: [0.6, 0.6, 0.6] }) - 1;
      gltf.scenes[0].nodes.push(node);
      return gltf.nodes[node];
    };
    const unlit = { pbrMetallicRoughness: { baseColorFactor: [0.9, 0.7, 0.1, 1] }, extensions: { KHR_materials_unlit: {} } };
    gltf.extensionsUsed.push('KHR_materials_unlit', 'KHR_node_visibility');
    ball(gltf.materials.push(unlit) - 1, [0.5, -0.6, 0]);
    ball(gltf.meshes[0].primitives[0].material, [0.1, 0.2, -0.2]).extensions = { KHR_node_visibility: { visible: false } };
    for (const other of ['a morph target at its weight', 'a skin in its pose', 'a picture whose Exif data turn it', 'a scene far away']) SCENES[other](gltf);
  },
};

/** Which scenes have a mesh that bends. */
const BENT = /skin|morph|all of these/;

for (const [name, change] of Object.entries(SCENES))
  test(`${name} looks on the page as in lightwell render`, async (t) => {
    const scene = writeScene(`${folder}/${name}.gltf`, SHAPES, LAMPS);
    const gltf = JSON.parse(readFileSync(scene, 'utf8'));
    gltf.cameras = [{ type: 'perspective', perspective: { yfov: 1, znear: 0.01 } }];
    gltf.scenes[0].nodes.push(gltf.nodes.push({ camera: 0, translation: [0, 0, 0.95] }) - 1);
    gltf.extensionsUsed.push('KHR_materials_specular');
    change(gltf);
    writeFileSync(scene, JSON.stringify(gltf));
    const pack = bake(scene, `${folder}/${name}.lw.glb`);
    const routes = { ...(await scriptPage('tests/e2e/pages/lambert.ts')), ...CLIENT, '/pack.lw.glb': pack };
    const server = await forTest(t, startStaticServer(routes));
    const { page, errors } = await forTest(t, openPage(browser));
    await page.goto(`${server.url}?light=total`);
    await page.setViewportSize({ width: SIZE[0], height: SIZE[1] });
    await complete(page);
    // What bends is not shown whole at once, but refined.
    assert.equal(readFileSync(pack).includes('"deformation"'), BENT.test(name));
    const url = await page.evaluate(() => document.querySelector('lightwell-view').toDataURL());
    writeFileSync(`${folder}/page.png`, Buffer.from(url.split(',')[1], 'base64'));
    const picture = ['--integrator', 'ivg', '--tone', 'none', '--size', SIZE.join('x'), '--spp', '64'];
    lightwell('render', pack, '-o', `${folder}/render.png`, ...picture);
    const { mean, p95 } = JSON.parse(lightwell('diff', `${folder}/page.png`, `${folder}/render.png`, '--metric', 'deltae', '--json'));
    assert.ok(mean <= MEAN && p95 <= P95, `mean ${mean}, 95th percentile ${p95}`);
    assert.deepEqual(errors, []);
  });

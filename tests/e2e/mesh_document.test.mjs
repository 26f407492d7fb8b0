// SPDX-License-Identifier: Apache-2.0
//
// docs/format.md is enough to read a mesh stream: a decoder written from it in another language ends in what the product's own does.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { ROOT } from './dependencies.mjs';
import { BIN, bake, temporaryFolder } from './packs.mjs';
import { meshStreams, PlainMesh } from './plain_mesh_decoder.mjs';
import { sphere, writeScene } from './scenes.mjs';

const folder = temporaryFolder();
/** Of a normal's 10 bits an axis, which is 0.2 degrees. */
const SAME_NORMAL = Math.cos((0.2 * Math.PI) / 180);

const ARRAYS = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const NUMBERS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

/** The arrays of all primitives of the glTF that the product exports. */
function exported(pack) {
  const file = `${pack}.all.glb`;
  execFileSync(`${BIN}/lightwell`, ['export', pack, '-o', file, '--json']);
  const glb = readFileSync(file);
  const length = glb.readUInt32LE(12);
  const { meshes, accessors, bufferViews } = JSON.parse(glb.subarray(20, 20 + length).toString());
  const bin = glb.subarray(28 + length);
  const read = (number) => {
    if (number === undefined) return null;
    const { bufferView, byteOffset = 0, componentType, count, type } = accessors[number];
    const [Type, numbers] = [ARRAYS[componentType], NUMBERS[type]];
    const { byteOffset: begin = 0, byteStride = numbers * Type.BYTES_PER_ELEMENT } = bufferViews[bufferView];
    return Array.from({ length: count }, (_, i) => {
      const at = begin + byteOffset + i * byteStride;
      return [...new Type(bin.buffer.slice(bin.byteOffset + at, bin.byteOffset + at + numbers * Type.BYTES_PER_ELEMENT))];
    });
  };
  return meshes.flatMap(({ primitives }) =>
    primitives.map(({ attributes, indices }) => ({
      positions: read(attributes.POSITION),
      normals: read(attributes.NORMAL),
      texcoords: read(attributes.TEXCOORD_0),
      colors: read(attributes.COLOR_0),
      indices: read(indices).flat(),
    })),
  );
}

/** The unit vector of a point of the octahedral square. */
function direction([u, v]) {
  let [x, y] = [u / 511, v / 511];
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
  const size = Math.hypot(x, y, z);
  return [x / size, y / size, z / size];
}

function assertReads(pack, least) {
  const whole = exported(pack);
  const streams = meshStreams(readFileSync(pack)).filter(({ payloads }) => payloads.length > 0);
  assert.ok(streams.length >= least, `${streams.length} streams`);
  for (const stream of streams) {
    assert.equal(stream.codec, 1);
    const mesh = new PlainMesh(stream);
    for (const payload of stream.payloads) mesh.append(payload);
    const { layout } = stream;
    const own = whole.find(({ positions, indices }) => positions.length === layout.vertices && indices.length === 3 * layout.faces);
    assert.ok(own !== undefined, `a mesh of ${layout.vertices} vertices and ${layout.faces} faces`);
    assert.deepEqual(mesh.faces.flat(), own.indices);
    const values = (codes, exponent) => codes.map((code) => code.map((x) => x * 2 ** exponent));
    assert.deepEqual(values(mesh.positions, layout.exponents[0]), own.positions);
    if (mesh.texcoords[0] !== null) assert.deepEqual(values(mesh.texcoords[0], layout.exponents[1]), own.texcoords);
    if (layout.attributes & 1) assert.equal(mesh.normals.size, layout.vertices - mesh.baseVertices);
    for (const [v, code] of mesh.normals) {
      const cosine = direction(code).reduce((sum, x, i) => sum + x * own.normals[v][i], 0);
      assert.ok(cosine > SAME_NORMAL, `vertex ${v}: ${direction(code)}, not ${own.normals[v]}`);
    }
    mesh.colors?.forEach((color, v) =>
      color.forEach((code, i) => {
        const linear = i < 3 ? (code / 255) ** 2 : code / 255;
        assert.ok(Math.abs(linear - (own.colors[v][i] ?? 1) / 65535) < 1e-4 || own.colors[v][i] === undefined, `${linear}, ${own.colors[v]}`);
      }),
    );
  }
  return streams;
}

test('of the example in the document', () => {
  const text = readFileSync(`${ROOT}docs/format.md`, 'utf8').split('### An example')[1].split('```')[1];
  const rows = (name) => [...text.matchAll(new RegExp(`^${name} +(.*)$`, 'gm'))].map(([, row]) => row.split(/ +/));
  const threes = (name) => rows(name)[0].map(Number).reduce((all, x, i) => (i % 3 === 0 ? [...all, [x]] : [...all.slice(0, -1), [...all.at(-1), x]]), []);
  const exponents = [-3, 0, 0];
  const base = { positions: threes('positions').map((p) => p.map((x) => x * 2 ** exponents[0])), faces: threes('faces'), texcoords: [null, null], colors: null };
  const mesh = new PlainMesh({ layout: { vertices: 7, faces: 10, loose: 0, attributes: 1, exponents }, base });
  for (const row of rows('block')) mesh.append(Uint8Array.from(row, (byte) => parseInt(byte, 16)));
  assert.deepEqual(mesh.positions.slice(5), [[32, 0, 0], [0, 24, 0]]);
  assert.equal(mesh.faces.length, 10);
  assert.deepEqual([...mesh.normals], [[5, [341, -170]], [6, [-153, 358]]]);
});

const BAKING = { environment: '1,1,1', photons: 1000, grid: 4 };
const WHITE = { pbrMetallicRoughness: { metallicFactor: 0 } };

test('of a surface with seams', () => {
  const scene = writeScene(`${folder}/sphere.gltf`, [{ mesh: sphere(0.5, 24), material: WHITE }], []);
  assertReads(bake(scene, `${folder}/sphere.lw.glb`, BAKING), 1);
});

/** Cuts a shape's faces into pieces by turns of some of them, each a primitive of one mesh. */
function writePieces(file, shape, count) {
  const faces = Array.from({ length: shape.indices.length / 3 }, (_, i) => shape.indices.slice(3 * i, 3 * i + 3));
  const pieces = Array.from({ length: count }, (_, piece) => ({
    mesh: { ...shape, indices: faces.filter((_, i) => Math.floor(i / 17) % count === piece).flat() },
    material: WHITE,
  }));
  writeScene(file, pieces, []);
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.meshes = [{ primitives: gltf.meshes.flatMap(({ primitives }) => primitives) }];
  gltf.nodes = [{ mesh: 0 }];
  gltf.scenes[0].nodes = [0];
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

test('of primitives that share a stream', () => {
  const pack = bake(writePieces(`${folder}/pieces.gltf`, sphere(0.5, 60), 3), `${folder}/pieces.lw.glb`, BAKING);
  const [stream, ...others] = meshStreams(readFileSync(pack)).filter(({ payloads }) => payloads.length > 0);
  assert.deepEqual([stream.codec, stream.layout.regions.length, others.length], [2, 3, 0]);
  const mesh = new PlainMesh(stream);
  for (const payload of stream.payloads) mesh.append(payload);
  assert.equal(mesh.regions.length, mesh.faces.length);
  exported(pack).forEach((own, region) => {
    const found = mesh.faces.filter((_, face) => mesh.regions[face] === region);
    const used = [...new Set(found.flat())].sort((a, b) => a - b);
    const number = new Map(used.map((v, i) => [v, i]));
    assert.deepEqual(found.flat().map((v) => number.get(v)), own.indices);
    assert.deepEqual(used.map((v) => mesh.positions[v].map((x) => x * 2 ** stream.layout.exponents[0])), own.positions);
    assert.deepEqual(used.map((v) => mesh.texcoords[0][v].map((x) => x * 2 ** stream.layout.exponents[1])), own.texcoords);
  });
});

/** A hilly field with a colour at each vertex and a border; `spoilt` changes its faces, each a list of corners. */
function writeField(file, side, spoilt = (faces) => faces) {
  const vertices = [];
  const faces = [];
  for (let y = 0; y < side; y++)
    for (let x = 0; x < side; x++) {
      const height = 0.1 * Math.sin(0.7 * x) * Math.cos(0.5 * y);
      vertices.push(`${x / side} ${height} ${y / side} ${(x * 11) % 256} ${(y * 7) % 256} ${(x * y) % 256}`);
      const [a, b] = [y * side + x, (y + 1) * side + x];
      if (x + 1 < side && y + 1 < side) faces.push([a, b, a + 1], [a + 1, b, b + 1]);
    }
  const rows = spoilt(faces).map((face) => `3 ${face.join(' ')}`);
  const properties = ['float x', 'float y', 'float z', 'uchar red', 'uchar green', 'uchar blue'].map((name) => `property ${name}\n`).join('');
  const header = `ply\nformat ascii 1.0\nelement vertex ${vertices.length}\n${properties}element face ${rows.length}\nproperty list uchar int vertex_indices\nend_header\n`;
  writeFileSync(file, `${header}${[...vertices, ...rows].join('\n')}\n`);
  return file;
}

test('of a surface with colours and a border', () => {
  assertReads(bake(writeField(`${folder}/field.ply`, 40), `${folder}/field.lw.glb`, BAKING), 1);
});

/** Some faces get a corner elsewhere, some come twice, some have two corners at one place. */
function spoil(faces) {
  let state = 7;
  const random = () => (state = (state * 1103515245 + 12345) % 2 ** 31) / 2 ** 31;
  const elsewhere = ([a, b, c]) => [a, b, Math.max(0, c - 3 - Math.floor(90 * random()))];
  return faces.flatMap((face, i) => [random() < 0.1 ? elsewhere(face) : face, ...(i % 20 === 0 ? [face] : []), ...(i % 33 === 0 ? [[face[0], face[0], face[1]]] : [])]);
}

test('of what is no surface: edges of many faces, faces that take no part', () => {
  const [{ layout }] = assertReads(bake(writeField(`${folder}/spoilt.ply`, 60, spoil), `${folder}/spoilt.lw.glb`, BAKING), 1);
  assert.ok(layout.loose > 0);
});

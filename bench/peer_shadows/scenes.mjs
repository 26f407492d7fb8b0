// SPDX-License-Identifier: Apache-2.0
//
// The scenes in which shadows are held against the truth: objects of { name, mesh }, a square lamp as LIGHTWELL_lamps has it, and a
// camera. The floor is what is looked at, and has texture coordinates from 0 to 1, as light maps need them.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { NodeIO } from '../../tests/e2e/dependencies.mjs';
import { bake, BIN } from '../../tests/e2e/packs.mjs';
import { writeScene } from '../../tests/e2e/scenes.mjs';

const GREY = { pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1, baseColorFactor: [0.7, 0.7, 0.7, 1] } };
const SHINING = { pbrMetallicRoughness: { baseColorFactor: [0, 0, 0, 1], metallicFactor: 0 }, emissiveFactor: [1, 1, 1] };

/** A rectangle from a corner along two sides; the normal is u x v. */
function rectangle(corner, u, v) {
  const normal = normalOf(u, v);
  const at = (s, t) => corner.map((c, i) => c + s * u[i] + t * v[i]);
  const corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
  return {
    positions: corners.flatMap(([s, t]) => at(s, t)),
    normals: corners.flatMap(() => normal),
    texcoords: corners.flat(),
    indices: [0, 1, 2, 0, 2, 3],
  };
}

/** Boxes of { center, size } as one mesh, whose texture coordinates are one place: they cast shadows and are not looked at. */
function boxes(all) {
  const mesh = { positions: [], normals: [], texcoords: [], indices: [] };
  for (const { center, size } of all)
    for (let axis = 0; axis < 3; axis++)
      for (const side of [-1, 1]) {
        const along = [0, 1, 2].map((i) => [0, 1, 2].map((k) => (k === (axis + i) % 3 ? size[k] : 0)));
        const [u, v] = side > 0 ? [along[1], along[2]] : [along[2], along[1]];
        const corner = center.map((c, k) => c + (side * along[0][k] - u[k] - v[k]) / 2);
        const face = rectangle(corner, u, v);
        const first = mesh.positions.length / 3;
        mesh.positions.push(...face.positions);
        mesh.normals.push(...face.normals);
        mesh.texcoords.push(...face.texcoords.map(() => 0.5));
        mesh.indices.push(...face.indices.map((i) => first + i));
      }
  return mesh;
}

function normalOf(a, b) {
  const across = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  return across.map((x) => x / Math.hypot(...across));
}

/** A square lamp that shines down with a radiance of 1. */
const lampAt = (center, half) => ({ kind: 'rectangle', center, normal: [0, -1, 0], u: [half, 0, 0], v: [0, 0, half], radiance: [1, 1, 1] });

const floor = (half) => ({ name: 'floor', mesh: rectangle([-half, 0, half], [2 * half, 0, 0], [0, 0, -2 * half]) });

/** Slats of a blind, which hangs flat below the lamp. */
const bars = {
  name: 'bars',
  objects: [floor(2), { name: 'slats', mesh: boxes(Array.from({ length: 11 }, (_, i) => ({ center: [0.18 * (i - 5), 0.5, 0], size: [0.07, 0.02, 1.6] }))) }],
  lamp: lampAt([0, 2.5, 0], 0.3),
  camera: { from: [0, 2.1, 2.6], to: [0, 0, 0.25], fov: 42 },
  nearest: 1.9,
};

/** Blocks that stand on the floor and one that hangs over it. */
const blocks = {
  name: 'blocks',
  objects: [
    floor(2),
    {
      name: 'blocks',
      mesh: boxes([
        { center: [-0.7, 0.35, -0.2], size: [0.4, 0.7, 0.4] },
        { center: [0.1, 0.15, 0.3], size: [0.3, 0.3, 0.3] },
        { center: [0.8, 0.5, -0.1], size: [0.25, 1, 0.25] },
        { center: [0.2, 0.8, -0.5], size: [0.9, 0.05, 0.3] },
      ]),
    },
  ],
  lamp: lampAt([0.2, 2.5, 0.4], 0.4),
  camera: { from: [0, 2.4, 2.9], to: [0, 0.2, -0.2], fov: 42 },
  nearest: 1.4,
};

/** The built-in room with a knot. */
async function boxSmall(folder) {
  const [pack, plain] = ['box-small.lw.glb', 'box-small.glb'].map((name) => join(folder, name));
  bake('box-small', pack, { photons: 20_000, grid: 4 });
  execFileSync(`${BIN}/lightwell`, ['export', pack, '-o', plain, '--quiet']);
  const file = readFileSync(pack);
  const header = JSON.parse(file.subarray(20, 20 + file.readUInt32LE(12)));
  const [lamp] = header.extensions.LIGHTWELL_lamps.lamps;
  const objects = [];
  for (const node of (await new NodeIO().setLogger(QUIET).read(plain)).getRoot().listNodes()) {
    const [primitive] = node.getMesh()?.listPrimitives() ?? [];
    if (primitive === undefined || node.getName() === 'lamp') continue;
    const place = (i) => transform(node.getWorldMatrix(), primitive.getAttribute('POSITION').getElement(i, []));
    const positions = Array.from(primitive.getIndices().getArray(), place).flat();
    objects.push({ name: node.getName(), mesh: flat(positions, node.getName() === 'floor') });
  }
  return { name: 'box-small', objects, lamp, camera: { from: [0, 2.2, 2.4], to: [0, 1.2, -1], fov: 62 }, nearest: 1, file: pack };
}

/** What the reader says of extensions it does not know is no error here. */
const QUIET = { debug() {}, info() {}, warn() {}, error: console.error };

const transform = (matrix, point) => [0, 1, 2].map((row) => point.reduce((sum, x, axis) => sum + matrix[4 * axis + row] * x, matrix[12 + row]));

/** Triangles that share no corner, each with its own normal; coordinates over the width and depth of a floor, or one place. */
function flat(positions, isFloor) {
  const mesh = { positions, normals: [], texcoords: [], indices: Array.from({ length: positions.length / 3 }, (_, i) => i) };
  const corner = (i) => positions.slice(3 * i, 3 * i + 3);
  for (let i = 0; i < positions.length / 3; i += 3) {
    const normal = normalOf(...[1, 2].map((k) => corner(i + k).map((x, axis) => x - corner(i)[axis])));
    mesh.normals.push(...normal, ...normal, ...normal);
  }
  const [x, z] = [0, 2].map((axis) => positions.filter((_, i) => i % 3 === axis)).map((all) => ({ least: Math.min(...all), most: Math.max(...all) }));
  for (let i = 0; i < positions.length; i += 3)
    mesh.texcoords.push(...(isFloor ? [(positions[i] - x.least) / (x.most - x.least), (z.most - positions[i + 2]) / (z.most - z.least)] : [0.5, 0.5]));
  return mesh;
}

/** All scenes; `file` of each is what lightwell traces rays in. */
export async function scenesIn(folder) {
  const made = [bars, blocks].map((scene) => {
    const { center, u, v } = scene.lamp;
    const lamp = rectangle(center.map((c, i) => c - u[i] - v[i]), u.map((x) => 2 * x), v.map((x) => 2 * x));
    const shapes = [...scene.objects.map(({ mesh }) => ({ mesh, material: GREY })), { mesh: lamp, material: SHINING }];
    return { ...scene, file: writeScene(join(folder, `${scene.name}.gltf`), shapes) };
  });
  return [...made, await boxSmall(folder)];
}

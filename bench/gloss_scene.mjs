// SPDX-License-Identifier: Apache-2.0
//
// gloss_scene.mjs FILE [SMOOTHEST]: writes a glTF scene of a glossy floor under a rectangle and a disc that shine: below each six strips, dielectrics
// and metals of roughness 0.15 (or SMOOTHEST), 0.3 and 0.6, and a matt wall behind. `lightwell render` has no facets smoother than 0.14.
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { writeScene } from '../tests/e2e/scenes.mjs';

const SMOOTHEST = 0.15;
/** Of a strip, metres. */
const WIDTH = 0.2;
const LENGTH = 3;
const HEIGHT = 1.6;

/** A flat polygon round its first corner; all of it faces one way. */
function flat(corners, normal) {
  return {
    positions: corners.flat(),
    normals: corners.flatMap(() => normal),
    texcoords: corners.flatMap(() => [0, 0]),
    indices: corners.slice(2).flatMap((_, i) => [0, i + 1, i + 2]),
  };
}

const rectangle = ([x0, x1], y, [z0, z1], up) => flat([[x0, y, z1], [x1, y, z1], [x1, y, z0], [x0, y, z0]], [0, 1, 0].map((c) => c * up));

function disc([x, y, z], radius, sides = 48) {
  const corners = Array.from({ length: sides }, (_, i) => [x + radius * Math.cos((2 * Math.PI * i) / sides), y, z + radius * Math.sin((2 * Math.PI * i) / sides)]);
  return flat(corners, [0, -1, 0]);
}

/** Turned over: the corners the other way round. */
const over = (mesh) => ({ ...mesh, indices: mesh.indices.toReversed() });

const matt = { pbrMetallicRoughness: { baseColorFactor: [0.6, 0.6, 0.6, 1], metallicFactor: 0, roughnessFactor: 1 } };
const shining = { pbrMetallicRoughness: { baseColorFactor: [0, 0, 0, 1] }, emissiveFactor: [1, 1, 1] };

/** Writes the scene; gives the file's name. */
export function writeGlossScene(file, smoothest = SMOOTHEST) {
  const surfaces = [0, 1].flatMap((metallicFactor) => [smoothest, 0.3, 0.6].map((roughnessFactor) => ({ metallicFactor, roughnessFactor })));
  const strips = [-surfaces.length, 0].flatMap((first) =>
    surfaces.map(({ metallicFactor, roughnessFactor }, i) => {
      const left = (first + i) * WIDTH;
      const baseColorFactor = metallicFactor ? [0.9, 0.75, 0.5, 1] : [0.1, 0.1, 0.15, 1];
      return { mesh: rectangle([left, left + WIDTH], 0, [-LENGTH / 2, LENGTH / 2], 1), material: { pbrMetallicRoughness: { baseColorFactor, metallicFactor, roughnessFactor } } };
    }),
  );
  const half = surfaces.length * WIDTH;
  const wall = flat([[-half, 0, -LENGTH / 2], [half, 0, -LENGTH / 2], [half, HEIGHT, -LENGTH / 2], [-half, HEIGHT, -LENGTH / 2]], [0, 0, 1]);
  writeScene(file, [
    ...strips,
    { mesh: wall, material: matt },
    { mesh: over(rectangle([-1.1, -0.1], HEIGHT - 0.2, [-1, -0.5], -1)), material: { ...shining, name: 'rectangle' } },
    { mesh: disc([0.6, HEIGHT - 0.2, -0.75], 0.45), material: { ...shining, name: 'disc' } },
  ]);

  // Seen from before the strips, a little from above.
  const gltf = JSON.parse(readFileSync(file, 'utf8'));
  gltf.cameras = [{ type: 'perspective', perspective: { yfov: 0.7, aspectRatio: 16 / 9, znear: 0.05 } }];
  gltf.scenes[0].nodes.push(gltf.nodes.length);
  gltf.nodes.push({ camera: 0, translation: [0, 1.7, 2.5], rotation: [Math.sin(-0.26), 0, 0, Math.cos(0.26)] });
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [file, smoothest = SMOOTHEST] = process.argv.slice(2);
  if (file === undefined) throw new Error('usage: node bench/gloss_scene.mjs FILE [SMOOTHEST]');
  writeGlossScene(file, Number(smoothest));
}

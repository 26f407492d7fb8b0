// SPDX-License-Identifier: Apache-2.0
//
// glTF scenes that tests make up.
import { writeFileSync } from 'node:fs';

/** A PNG of one grey pixel. */
const GREY_PIXEL =
  'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaGgAAAMEAYFL09IQAAAAAElFTkSuQmCC';

/** A cube's six faces, each turned inwards for a room, 2 `size` long. */
export function room(size) {
  const cube = { positions: [], normals: [], texcoords: [], indices: [] };
  for (let axis = 0; axis < 3; axis++)
    for (const side of [-1, 1]) {
      const first = cube.positions.length / 3;
      for (const [u, v] of [[-1, -1], [side, -side], [1, 1], [-side, side]]) {
        const place = (a, b, c) => [a, b, c].map((_, i) => [a, b, c][(i + 3 - axis) % 3]);
        cube.positions.push(...place(side * size, u * size, v * size));
        cube.normals.push(...place(-side, 0, 0));
        cube.texcoords.push((u + 1) / 2, (v + 1) / 2);
      }
      cube.indices.push(...[0, 2, 1, 0, 3, 2].map((corner) => first + corner));
    }
  return cube;
}

/** A sphere of `steps` by 2 `steps` cells. */
export function sphere(radius, steps = 24) {
  const ball = { positions: [], normals: [], texcoords: [], indices: [] };
  for (let i = 0; i <= steps; i++)
    for (let j = 0; j <= 2 * steps; j++) {
      const [theta, phi] = [(Math.PI * i) / steps, (Math.PI * j) / steps];
      const normal = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi)];
      ball.positions.push(...normal.map((n) => radius * n));
      ball.normals.push(...normal);
      ball.texcoords.push(j / (2 * steps), i / steps);
      if (i === steps || j === 2 * steps) continue;
      const [a, b] = [i * (2 * steps + 1) + j, (i + 1) * (2 * steps + 1) + j];
      ball.indices.push(a, b, b + 1, a, b + 1, a + 1);
    }
  return ball;
}

/**
 * Writes a .gltf file of some shapes, each { mesh, material, at }, with lamps as in KHR_lights_punctual, each { lamp, at }. The one
 * texture of the scene, number 0, is grey.
 */
export function writeScene(file, shapes, lamps = []) {
  const pieces = [];
  const bufferViews = [];
  const accessors = [];
  const add = (array, type, extra = {}) => {
    const byteOffset = pieces.reduce((sum, piece) => sum + piece.length, 0);
    const bytes = Buffer.from(array.buffer);
    pieces.push(bytes);
    bufferViews.push({ buffer: 0, byteOffset, byteLength: bytes.length });
    const componentType = array instanceof Uint32Array ? 5125 : 5126;
    const components = { SCALAR: 1, VEC2: 2, VEC3: 3 }[type];
    accessors.push({ bufferView: bufferViews.length - 1, componentType, count: array.length / components, type, ...extra });
    return accessors.length - 1;
  };
  const bound = (values, choose) => [0, 1, 2].map((axis) => choose(...values.filter((_, i) => i % 3 === axis)));
  const meshes = shapes.map(({ mesh }, material) => {
    const positions = Float32Array.from(mesh.positions);
    const POSITION = add(positions, 'VEC3', { min: bound(positions, Math.min), max: bound(positions, Math.max) });
    const NORMAL = add(Float32Array.from(mesh.normals), 'VEC3');
    const TEXCOORD_0 = add(Float32Array.from(mesh.texcoords), 'VEC2');
    const indices = add(Uint32Array.from(mesh.indices), 'SCALAR');
    return { primitives: [{ attributes: { POSITION, NORMAL, TEXCOORD_0 }, indices, material }] };
  });
  const shapeNodes = shapes.map(({ at = [0, 0, 0] }, mesh) => ({ mesh, translation: at }));
  const lampNodes = lamps.map(({ at, rotation = [0, 0, 0, 1] }, light) => ({
    translation: at,
    rotation,
    extensions: { KHR_lights_punctual: { light } },
  }));
  const nodes = [...shapeNodes, ...lampNodes];
  const buffer = Buffer.concat(pieces);
  const materials = shapes.map(({ material }) => material);
  const extensions = new Set(materials.flatMap((material) => Object.keys(material.extensions ?? {})));
  const gltf = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: nodes.map((_, i) => i) }],
    nodes,
    meshes,
    materials,
    textures: [{ source: 0 }],
    images: [{ uri: GREY_PIXEL }],
    accessors,
    bufferViews,
    buffers: [{ byteLength: buffer.length, uri: `data:application/octet-stream;base64,${buffer.toString('base64')}` }],
  };
  if (lamps.length > 0) {
    extensions.add('KHR_lights_punctual');
    gltf.extensions = { KHR_lights_punctual: { lights: lamps.map(({ lamp }) => lamp) } };
  }
  if (extensions.size > 0) gltf.extensionsUsed = [...extensions];
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

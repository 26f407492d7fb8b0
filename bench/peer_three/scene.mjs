// SPDX-License-Identifier: Apache-2.0
import { NodeIO } from '../../tests/e2e/dependencies.mjs';

/** Keeps quiet about extensions that the reader does not know: that a lamp is one shows without its strength. */
const QUIET = { debug() {}, info() {}, warn() {}, error: console.error };

/** Triangles of a glTF file as attributes of three.js's, those of lamps apart, and the corners of their box. */
export async function readTriangles(file) {
  const lit = { position: [], normal: [], color: [] };
  const lamps = { position: [] };
  for (const node of (await new NodeIO().setLogger(QUIET).read(file)).getRoot().listNodes())
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) addTriangles(primitive, node.getWorldMatrix(), lit, lamps);
  return { lit, lamps, bounds: boxOf([...lit.position, ...lamps.position]) };
}

function addTriangles(primitive, matrix, lit, lamps) {
  const material = primitive.getMaterial();
  const isLamp = Math.max(...material.getEmissiveFactor()) > 0;
  const position = primitive.getAttribute('POSITION');
  const corners = Array.from(primitive.getIndices().getArray(), (i) => transform(matrix, position.getElement(i, [])));
  for (const corner of corners) (isLamp ? lamps : lit).position.push(...corner);
  if (isLamp) return;
  const albedo = material.getBaseColorFactor().slice(0, 3);
  for (let i = 0; i < corners.length; i += 3) {
    const normal = normalOf(...corners.slice(i, i + 3));
    lit.normal.push(...normal, ...normal, ...normal);
    lit.color.push(...albedo, ...albedo, ...albedo);
  }
}

function transform(matrix, point) {
  return [0, 1, 2].map((row) => point.reduce((sum, x, axis) => sum + matrix[4 * axis + row] * x, matrix[12 + row]));
}

function normalOf(a, b, c) {
  const [u, v] = [b, c].map((corner) => corner.map((x, axis) => x - a[axis]));
  const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  return normal.map((x) => x / Math.hypot(...normal));
}

function boxOf(positions) {
  const corners = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((x, i) => {
    corners[0][i % 3] = Math.min(corners[0][i % 3], x);
    corners[1][i % 3] = Math.max(corners[1][i % 3], x);
  });
  return corners;
}

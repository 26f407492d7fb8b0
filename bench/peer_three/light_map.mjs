// SPDX-License-Identifier: Apache-2.0
//
// Lays out a light map: a chart a triangle, in which the triangle's corners are centres of texels.

/** Texels on the diagonal of a scene's box. */
const TEXELS = 192;
/** Of the way to a triangle's middle: how far texels are moved, so that those of its edges do not lie in a neighbouring wall. */
const INWARDS = 1e-3;
/** Of the diagonal: how far off the surface light is measured. */
const OFF_SURFACE = 2e-5;

/**
 * Charts of triangles (nine coordinates each) in a box: the size of the map, the triangles' texture coordinates, and of each texel
 * that a picture can need where it lies in the map and in the scene.
 */
export function layOut(positions, normals, [least, most]) {
  const diagonal = distance(least, most);
  const texelsBetween = (a, b) => 1 + Math.max(1, Math.ceil((TEXELS * distance(a, b)) / diagonal));
  const charts = Array.from({ length: positions.length / 9 }, (_, triangle) => {
    const [a, b, c] = [0, 3, 6].map((corner) => positions.slice(9 * triangle + corner, 9 * triangle + corner + 3));
    const normal = normals.slice(9 * triangle, 9 * triangle + 3);
    return { triangle, corners: [a, b, c], normal, width: texelsBetween(a, b), height: texelsBetween(a, c) };
  });
  const { width, height } = place(charts);
  const coordinates = new Float32Array(6 * charts.length);
  for (const { triangle, x, y, ...chart } of charts) {
    const [left, top, right, bottom] = [x + 0.5, y + 0.5, x + chart.width - 0.5, y + chart.height - 0.5];
    coordinates.set([left, top, right, top, left, bottom].map((value, i) => value / (i % 2 ? height : width)), 6 * triangle);
  }
  return { width, height, coordinates, texels: charts.flatMap((chart) => texelsOf(chart, OFF_SURFACE * diagonal)) };
}

function distance(a, b) {
  return Math.hypot(...a.map((x, axis) => x - b[axis]));
}

/** Gives each chart a place, the highest first in rows from left to right; returns the size of all. */
function place(charts) {
  const area = charts.reduce((sum, chart) => sum + chart.width * chart.height, 0);
  const width = Math.max(Math.ceil(Math.sqrt(area)), ...charts.map((chart) => chart.width));
  let [x, y, row] = [0, 0, 0];
  for (const chart of charts.toSorted((a, b) => b.height - a.height)) {
    if (x + chart.width > width) [x, y, row] = [0, y + row, 0];
    Object.assign(chart, { x, y });
    x += chart.width;
    row = Math.max(row, chart.height);
  }
  return { width, height: y + row };
}

/** Texels on the triangle; those that only filtering across its longest side takes in get the light of that side. */
function texelsOf({ corners: [a, b, c], normal, x, y, width, height }, offSurface) {
  const texels = [];
  const [du, dv] = [1 / (width - 1), 1 / (height - 1)];
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++) {
      const beyond = Math.max(1, i * du + j * dv);
      if (beyond > 1 + du + dv) continue;
      const [u, v] = [i * du, j * dv].map((along) => (along / beyond) * (1 - INWARDS) + INWARDS / 3);
      const onSurface = a.map((from, axis) => from + u * (b[axis] - from) + v * (c[axis] - from));
      const position = onSurface.map((along, axis) => along + offSurface * normal[axis]);
      texels.push({ x: x + i, y: y + j, position, normal });
    }
  return texels;
}

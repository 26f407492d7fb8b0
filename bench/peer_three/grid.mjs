// SPDX-License-Identifier: Apache-2.0
//
// What three.js's light grid says at a point, and what it takes on the wire. A grid here is a cube of nodes, x fastest and z slowest,
// of nine coefficients of radiance, each red, green, blue.
import { gzipSync } from 'node:zlib';

const CHANNELS = 3;
/** Numbers a node. */
const VALUES = 9 * CHANNELS;

/** The values of the nodes from three.js's atlas: seven volumes of four numbers a node, each with a padding layer at both ends. */
export function unpackAtlas(atlas, nodes) {
  const layer = nodes * nodes;
  const values = new Float64Array(VALUES * layer * nodes);
  for (let node = 0; node < layer * nodes; node++)
    for (let i = 0; i < VALUES; i++) {
      const texel = node + layer * (1 + (i >> 2) * (nodes + 2));
      values[VALUES * node + i] = atlas[4 * texel + (i & 3)];
    }
  return values;
}

/**
 * Where the values of successive bounces go to. What is still missing of a channel shrinks by the same ratio a bounce, which is
 * taken from the mean radiance of the last three passes.
 */
export function limitOf(passes) {
  const [before, previous, last] = passes.slice(-3);
  const ratio = [0, 1, 2].map((channel) => step(previous, last, channel) / step(before, previous, channel));
  return last.map((value, i) => {
    const r = ratio[i % CHANNELS];
    return value + ((value - previous[i]) * r) / (1 - r);
  });
}

function step(from, to, channel) {
  let sum = 0;
  for (let i = channel; i < to.length; i += VALUES) sum += to[i] - from[i];
  return sum;
}

/**
 * Irradiance at a point by the formula of three.js's shader chunk `lightprobes_pars_fragment`: half a cell along the normal, no
 * further than the outermost nodes, trilinear. `bounds` are the volume's corners; nodes are at the centres of cells.
 */
export function irradianceAt(values, nodes, [least, most], position, normal) {
  const near = position.map((p, axis) => {
    const cell = (most[axis] - least[axis]) / nodes;
    return Math.min(Math.max((p - least[axis]) / cell + normal[axis] / 2 - 0.5, 0), nodes - 1);
  });
  const weights = basis(normal);
  const sum = [0, 0, 0];
  for (let corner = 0; corner < 8; corner++) {
    let node = 0;
    let share = 1;
    for (let axis = 2; axis >= 0; axis--) {
      const first = Math.min(Math.floor(near[axis]), nodes - 2);
      const upper = (corner >> axis) & 1;
      share *= upper ? near[axis] - first : 1 - (near[axis] - first);
      node = node * nodes + first + upper;
    }
    for (let i = 0; i < VALUES; i++)
      sum[i % CHANNELS] += share * weights[Math.floor(i / CHANNELS)] * values[VALUES * node + i];
  }
  return sum.map((value) => Math.max(value, 0));
}

/** Weights of the nine coefficients for a normal: the cosine lobe's (Ramamoorthi and Hanrahan 2001), with three.js's digits. */
function basis([x, y, z]) {
  const first = 2 * 0.511664;
  const second = 2 * 0.429043;
  return [
    0.886227,
    first * y,
    first * z,
    first * x,
    second * x * y,
    second * y * z,
    0.743125 * z * z - 0.247708,
    second * x * z,
    (second / 2) * (x * x - y * y),
  ];
}

/** Bytes of a grid as a file, gzip -9: the integers in JSON that three.js's pull request 33658 proposes, and 32-bit floats. */
export function bytesOnTheWire(values, nodes, [least, most]) {
  const [width, height, depth] = most.map((x, axis) => x - least[axis]);
  const sh = Array.from(values, (value) => Math.round(value * 4096));
  const json = { width, height, depth, resolution: [nodes, nodes, nodes], sh };
  const size = (data) => gzipSync(data, { level: 9 }).length;
  return { json: size(JSON.stringify(json)), floats: size(new Uint8Array(Float32Array.from(values).buffer)) };
}

// SPDX-License-Identifier: Apache-2.0
//
// What a camera makes of the order of the streams; no browser is needed for it.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { three } from './dependencies.mjs';
import { temporaryFolder } from './packs.mjs';
import { bundle } from './test_page.mjs';

const { BoxGeometry, Matrix4, Mesh, PerspectiveCamera } = three;
const folder = temporaryFolder();
writeFileSync(`${folder}/view_weights.mjs`, await bundle('web/src/three/view_weights.ts'));
const { viewWeights } = await import(`${folder}/view_weights.mjs`);

const HEIGHT = 720;
/** At the origin, looking along -z. */
const CAMERA = new PerspectiveCamera(45, 16 / 9, 0.1, 1000);

function cube(at, size = 1) {
  const mesh = new Mesh(new BoxGeometry(size, size, size));
  mesh.position.set(...at);
  mesh.updateMatrixWorld();
  return mesh;
}

/** The weight of each stream: meshes and images, each { mesh, ... }, and grids, each { min, size, bricks }, with boxes of bricks. */
function weightsOf({ meshes = [], images = [], grids = [] }) {
  let stream = 0;
  const number = (items, make) => new Map(items.map((item) => [stream++, make(item)]));
  const opening = {
    primitives: number(meshes, ({ mesh, error = 0.01 }) => [{ extension: { error }, meshes: [mesh].flat(), base: null }]),
    images: number(images, ({ mesh, previewSize = 16 }) => ({ meshes: [mesh].flat(), previewSize })),
  };
  const lights = grids.map(({ min, size, bricks = [] }) => ({
    definition: {
      stream: stream++,
      min,
      cell: [size / 8, size / 8, size / 8],
      nodes: [9, 9, 9],
      bricks: bricks.map((box) => ({ stream: stream++, ...box })),
    },
    matrixWorld: new Matrix4(),
  }));
  return viewWeights(opening, lights, CAMERA, HEIGHT)
    .sort(([a], [b]) => a - b)
    .map(([, weight]) => weight);
}

const near = cube([0, 0, -3]);
const far = cube([0, 0, -30]);
const behind = cube([0, 0, 3]);

test('what is near counts more than what is far, and what is out of sight little, not nothing', () => {
  const [first, second, third] = weightsOf({ meshes: [{ mesh: near }, { mesh: far }, { mesh: behind }] });
  assert.equal(first, 1);
  assert.ok(second < 0.01, `far ${second}`);
  assert.ok(third > 0 && third < 0.05, `behind ${third}`);
});

test('a mesh counts by its error, wherever it is nearest', () => {
  const [coarse, fine] = weightsOf({ meshes: [{ mesh: near, error: 0.04 }, { mesh: near, error: 0.01 }] });
  assert.equal(fine / coarse, 0.25);
  const [shownTwice, shownOnce] = weightsOf({ meshes: [{ mesh: [far, near] }, { mesh: near }] });
  assert.equal(shownTwice, shownOnce);
});

test('a scaled mesh has a scaled error', () => {
  const small = cube([0, 0, -4], 0.5);
  small.scale.setScalar(2);
  small.updateMatrixWorld();
  const [scaled, plain] = weightsOf({ meshes: [{ mesh: small, error: 0.01 }, { mesh: cube([0, 0, -4]), error: 0.02 }] });
  assert.ok(Math.abs(scaled / plain - 1) < 1e-6, `${scaled}, ${plain}`);
});

test('an image counts by the size of its texels on the screen', () => {
  const [coarse, fine, away] = weightsOf({ images: [{ mesh: near, previewSize: 8 }, { mesh: near, previewSize: 32 }, { mesh: far }] });
  assert.equal(fine / coarse, 0.25);
  assert.ok(away < 0.01 * coarse, `${away}`);
});

test('a texel counts as much as an error of its size', () => {
  const texel = Math.hypot(1, 1, 1) / 16;
  const [mesh, image] = weightsOf({ meshes: [{ mesh: near, error: texel }], images: [{ mesh: near, previewSize: 16 }] });
  assert.ok(Math.abs(mesh - image) < 1e-6, `${mesh}, ${image}`);
});

test('a light grid counts by the share of it that is seen', () => {
  const [whole, half, none] = weightsOf({
    grids: [{ min: [-1, -1, -20], size: 2 }, { min: [-10, -10, -10.001], size: 20 }, { min: [-1, -1, 5], size: 2 }],
  });
  assert.equal(whole, 1);
  assert.ok(half > 0.02 && half < 0.5, `round the camera ${half}`);
  assert.ok(none > 0 && none < 0.05, `behind ${none}`);
});

test('of the finer cells of a grid those in sight come first', () => {
  const [, before, behind, beside] = weightsOf({
    grids: [
      {
        min: [-10, -10, -10],
        size: 20,
        bricks: [
          { min: [-1, -1, -10], max: [1, 1, -8] },
          { min: [-1, -1, 8], max: [1, 1, 10] },
          { min: [-10, -1, -1], max: [-8, 1, 1] },
        ],
      },
    ],
  });
  assert.equal(before, 1);
  assert.ok(behind > 0 && behind < 0.05 && beside === behind, `behind ${behind}, beside ${beside}`);
});

// SPDX-License-Identifier: Apache-2.0
//
// White patches in a light grid that `lightwell export --light` wrote, lit by three.js's own class and shader.
import {
  Data3DTexture,
  DataUtils,
  FloatType,
  HalfFloatType,
  LinearFilter,
  Mesh,
  MeshLambertMaterial,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { LightProbeGridWebGL } from 'three/examples/jsm/lighting/LightProbeGridWebGL.js';

interface ExportedGrid {
  width: number;
  height: number;
  depth: number;
  resolution: [number, number, number];
  position: [number, number, number];
  coefficients: { scale: number; data: number[] };
}

/** Numbers a node, and volumes of four of them each in three.js's texture. */
const VALUES = 27;
const VOLUMES = 7;

/** The grid that three.js makes of such a file by its pull request 33658. */
function gridOf({ width, height, depth, resolution, position, coefficients }: ExportedGrid): LightProbeGridWebGL {
  const [nx, ny, nz] = resolution;
  const grid = new LightProbeGridWebGL(width, height, depth, nx, ny, nz);
  grid.position.fromArray(position);
  grid.updateBoundingBox();
  const slices = VOLUMES * (nz + 2);
  const halves = Uint16Array.from({ length: 4 * nx * ny * slices }, (_, i) => {
    const [channel, column, slice] = [i % 4, (i >> 2) % (nx * ny), Math.floor(i / (4 * nx * ny))];
    const value = 4 * Math.floor(slice / (nz + 2)) + channel;
    const z = Math.min(Math.max((slice % (nz + 2)) - 1, 0), nz - 1);
    const node = column + nx * ny * z;
    return value < VALUES ? DataUtils.toHalfFloat(coefficients.data[VALUES * node + value]! / coefficients.scale) : 0;
  });
  grid.texture = new Data3DTexture(halves, nx, ny, slices);
  grid.texture.type = HalfFloatType;
  grid.texture.minFilter = grid.texture.magFilter = LinearFilter;
  grid.texture.needsUpdate = true;
  return grid;
}

/** The irradiance that three.js finds at points with normals. */
export function run(exported: ExportedGrid, points: { position: number[]; normal: number[] }[]): number[][] {
  const renderer = new WebGLRenderer();
  const target = new WebGLRenderTarget(1, 1, { type: FloatType });
  const patch = new Mesh(new PlaneGeometry(1e-3, 1e-3), new MeshLambertMaterial());
  const scene = new Scene().add(gridOf(exported), patch);
  const camera = new OrthographicCamera(-1e-4, 1e-4, 1e-4, -1e-4, 0.001, 1);
  const pixel = new Float32Array(4);
  renderer.setRenderTarget(target);
  const measured = points.map(({ position, normal }) => {
    const [place, towards] = [new Vector3(...position), new Vector3(...normal)];
    patch.position.copy(place);
    patch.lookAt(place.clone().add(towards));
    camera.position.copy(place).addScaledVector(towards, 0.1);
    camera.lookAt(place);
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    return [...pixel.subarray(0, 3)].map((radiance) => radiance * Math.PI);
  });
  renderer.dispose();
  return measured;
}

Object.assign(globalThis, { run });

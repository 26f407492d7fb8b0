// SPDX-License-Identifier: Apache-2.0
//
// Bakes three.js's light grid in a browser: `prepare` a scene, then one `bakePass` after the other, which returns the atlas.
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  FloatType,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Scene,
  WebGLRenderer,
} from 'three';
import { LightProbeGridWebGL } from 'three/addons/lighting/LightProbeGridWebGL.js';

/** The better of the settings: the default of 8 texels errs by 5 %, and what is nearer than the default of 0.1 is cut away. */
const CUBE_MAP = { cubemapSize: 16, near: 0.001 };

const renderer = new WebGLRenderer();
let scene, grid;

/** Lit triangles with their albedo and a light map of their direct irradiance, and lamps, which are black. */
globalThis.prepare = ({ lit, lamps, lightMap, bounds: [least, most], nodes }) => {
  const texture = new DataTexture(new Float32Array(lightMap.texels), lightMap.width, lightMap.height, undefined, FloatType);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  scene = new Scene();
  scene.add(new Mesh(geometry(lit), new MeshLambertMaterial({ vertexColors: true, lightMap: texture })));
  if (lamps.position.length > 0) scene.add(new Mesh(geometry(lamps), new MeshBasicMaterial({ color: 0 })));
  const [width, height, depth] = most.map((x, axis) => x - least[axis]);
  grid = new LightProbeGridWebGL(width, height, depth, nodes, nodes, nodes);
  grid.position.fromArray(least.map((x, axis) => (x + most[axis]) / 2));
  scene.add(grid);
};

/** Pass 0 holds what lit surfaces reflect, each pass after it one bounce more. */
globalThis.bakePass = (pass) => {
  grid.bake(renderer, scene, { ...CUBE_MAP, pass });
  const target = grid._renderTarget;
  const layer = 4 * target.width * target.height;
  const atlas = new Float32Array(layer * target.depth);
  for (let z = 0; z < target.depth; z++) {
    renderer.setRenderTarget(target, z);
    renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, atlas.subarray(z * layer, (z + 1) * layer));
  }
  renderer.setRenderTarget(null);
  return atlas;
};

function geometry(attributes) {
  const sizes = { uv: 2 };
  const result = new BufferGeometry();
  for (const [name, values] of Object.entries(attributes))
    result.setAttribute(name, new BufferAttribute(new Float32Array(values), sizes[name] ?? 3));
  return result;
}

globalThis.ready = true;

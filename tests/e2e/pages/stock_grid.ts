// SPDX-License-Identifier: Apache-2.0
//
// Renders a sphere in a light grid of three.js's own, with three.js's lookup and then with Lightwell's in its place.
import {
  Box3,
  Data3DTexture,
  DataUtils,
  FloatType,
  HalfFloatType,
  Light,
  LinearFilter,
  Mesh,
  MeshLambertMaterial,
  OrthographicCamera,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { installLightChunks } from '../../../web/src/three/shader_chunks.js';

const SIZE = 48;
const PROBES = new Vector3(3, 4, 5);

/** What the renderer takes for a grid of probes; its coefficients are of no real light, but all different. */
class StockGrid extends Light {
  readonly isLightProbeGrid = true;
  readonly priority = 0;
  readonly boundingBox = new Box3(new Vector3(-1, -1.2, -0.9), new Vector3(0.8, 1, 1.1));
  readonly resolution = PROBES;
  readonly texture: Data3DTexture;

  constructor() {
    super();
    const depth = 7 * (PROBES.z + 2);
    const values = Array.from({ length: 4 * PROBES.x * PROBES.y * depth }, (_, i) => 0.6 + 0.4 * Math.sin(37 * i));
    this.texture = new Data3DTexture(Uint16Array.from(values, DataUtils.toHalfFloat), PROBES.x, PROBES.y, depth);
    this.texture.type = HalfFloatType;
    this.texture.minFilter = this.texture.magFilter = LinearFilter;
    this.texture.needsUpdate = true;
  }
}

/** Red, green, blue and coverage of all pixels. A renderer of its own, since renderers keep the shaders that they have compiled. */
function picture(): number[] {
  const renderer = new WebGLRenderer();
  const target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });
  const sphere = new Mesh(new SphereGeometry(1.05, 48, 24), new MeshLambertMaterial());
  const camera = new OrthographicCamera(-1.1, 1.1, 1.1, -1.1, 0.1, 10);
  camera.position.set(1, 2, 3);
  camera.lookAt(0, 0, 0);
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.render(new Scene().add(sphere, new StockGrid()), camera);
  const pixels = new Float32Array(4 * SIZE * SIZE);
  renderer.readRenderTargetPixels(target, 0, 0, SIZE, SIZE, pixels);
  renderer.dispose();
  return [...pixels];
}

export function run(): { stock: number[]; patched: number[] } {
  const stock = picture();
  installLightChunks();
  return { stock, patched: picture() };
}

Object.assign(globalThis, { run });

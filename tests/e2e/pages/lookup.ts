// SPDX-License-Identifier: Apache-2.0
//
// Renders one fragment for each sample of tests/data/light/lookup.json and gives the irradiance that its material received.
import {
  BufferAttribute,
  BufferGeometry,
  FloatType,
  Group,
  Mesh,
  MeshLambertMaterial,
  OrthographicCamera,
  Quaternion,
  Scene,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { type LightLookup, LightwellLight } from '../../../web/src/three/light.js';

type Triple = [number, number, number];

interface Fixture {
  nodes: Triple;
  width: number;
  height: number;
  depth: number;
  halves: number[];
  placements: {
    min: Triple;
    max: Triple;
    resolution: Triple;
    samples: { point: Triple; normal: Triple }[];
  }[];
}

const renderer = new WebGLRenderer();
const target = new WebGLRenderTarget(1, 1, { type: FloatType });

function irradiance(scene: Scene, mesh: Mesh, point: Vector3, normal: Vector3): Triple {
  const size = 1e-3;
  const corners = [-1, -1, 3, -1, -1, 3];
  const positions = [0, 1, 2].flatMap((i) => [point.x + size * corners[2 * i]!, point.y + size * corners[2 * i + 1]!, point.z]);
  mesh.geometry = new BufferGeometry();
  mesh.geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  mesh.geometry.setAttribute('normal', new BufferAttribute(new Float32Array([0, 1, 2].flatMap(() => normal.toArray())), 3));
  const camera = new OrthographicCamera(-size, size, size, -size, 0.1, 2);
  camera.position.set(point.x, point.y, point.z + 1);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixel = new Float32Array(4);
  renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
  return [pixel[0]! * Math.PI, pixel[1]! * Math.PI, pixel[2]! * Math.PI];
}

/** The irradiance of all samples, a list for each placement of the grid. */
export function run(fixture: Fixture, lookup: LightLookup): Triple[][] {
  const { nodes, width, height, depth } = fixture;
  const cell: Triple = [0.5, 0.25, 0.125];
  const definition = { stream: 0, min: [0, 0, 0] as Triple, cell, nodes, normalOffset: 0.5 };
  const light = new LightwellLight(definition, { atlas: new Uint16Array(fixture.halves), width, height, depth }, lookup);
  const holder = new Group().add(light);
  const mesh = new Mesh(new BufferGeometry(), new MeshLambertMaterial());
  mesh.frustumCulled = false;
  const scene = new Scene().add(holder, mesh);
  return fixture.placements.map(({ min, max, resolution, samples }) => {
    const w = Math.sqrt(Math.max(0, 1 - new Vector3(...max).lengthSq()));
    holder.position.set(...min);
    holder.quaternion.copy(new Quaternion(...max, w));
    const size = new Vector3(...nodes).subScalar(1).multiply(new Vector3(...cell));
    holder.scale.set(resolution[0], resolution[1], -resolution[2]).divide(size);
    return samples.map(({ point, normal }) => irradiance(scene, mesh, new Vector3(...point), new Vector3(...normal)));
  });
}

/** The fragment shader of the lit material, its chunks included and its loops unrolled. */
export function fragmentShader(): string {
  const gl = renderer.getContext();
  const shaders = gl.getAttachedShaders(renderer.info.programs![0]!.program as WebGLProgram)!;
  return gl.getShaderSource(shaders.find((shader) => gl.getShaderParameter(shader, gl.SHADER_TYPE) === gl.FRAGMENT_SHADER)!)!;
}

Object.assign(globalThis, { run, fragmentShader });

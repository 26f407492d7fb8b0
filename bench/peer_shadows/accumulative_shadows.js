// SPDX-License-Identifier: Apache-2.0
//
// What AccumulativeShadows of @react-three/drei does, written anew for three.js alone: a picture of the floor by its texture coordinates, drawn
// with jittered lights; each frame of N takes the Nth part of it. All other things only cast shadows.
import * as THREE from 'three';
import { JitteredLamp, sharesOf } from './jittered.js';
import { pixelsOf, renderer, stage } from './stage.js';

const SIZE = 1024;

/** Shares on the floor, from anew for each number of frames, as the component takes that number beforehand. */
export const accumulativeShadows = (definition, counts, kind) => counts.map((count) => accumulated(definition, count, kind));

function accumulated(definition, count, kind) {
  const { scene, floor, meshes, camera } = stage(definition);
  const lamp = new JitteredLamp(definition.lamp, kind, 1);
  scene.add(...lamp.lights);
  const targets = [0, 1].map(() => new THREE.WebGLRenderTarget(SIZE, SIZE, { type: THREE.FloatType, depthBuffer: false }));
  const uniforms = { before: { value: null }, part: { value: 1 / count } };
  const shown = floor.material;
  const unfolded = new THREE.MeshLambertMaterial();
  unfolded.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = `varying vec2 place;\n${shader.vertexShader.replace(/}\s*$/, 'place=uv;gl_Position=vec4(2.0*uv-1.0,0.0,1.0);}')}`;
    const blend = 'gl_FragColor=mix(texture2D(before,place),gl_FragColor,part);}';
    shader.fragmentShader = `varying vec2 place;uniform sampler2D before;uniform float part;\n${shader.fragmentShader.replace(/}\s*$/, blend)}`;
  };
  const unseen = new THREE.MeshBasicMaterial({ colorWrite: false, depthWrite: false, side: THREE.DoubleSide });
  for (const mesh of meshes) mesh.material = mesh === floor ? unfolded : unseen;
  floor.frustumCulled = false;
  renderer.setClearColor(0, 0);
  for (let frame = 0; frame < count; frame++) {
    lamp.jitter();
    uniforms.before.value = targets[1].texture;
    renderer.setRenderTarget(targets[0]);
    renderer.render(scene, camera);
    targets.reverse();
  }
  scene.remove(...lamp.lights);
  for (const mesh of meshes) mesh.material = shown;
  floor.material = new THREE.MeshBasicMaterial({ map: targets[1].texture, side: THREE.DoubleSide });
  const shares = sharesOf(pixelsOf(scene, camera));
  targets.forEach((target) => target.dispose());
  return shares;
}

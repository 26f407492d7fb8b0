// SPDX-License-Identifier: Apache-2.0
//
// A scene of scenes.mjs in three.js, and what is read of its pictures.
import * as THREE from 'three';

export const WIDTH = 320;
export const HEIGHT = 180;

export const renderer = new THREE.WebGLRenderer();
renderer.shadowMap.enabled = true;

const PLACE = new THREE.ShaderMaterial({
  vertexShader: 'varying vec3 place;void main(){place=position;gl_Position=projectionMatrix*viewMatrix*vec4(position,1.0);}',
  fragmentShader: 'varying vec3 place;void main(){gl_FragColor=vec4(place,1.0);}',
  side: THREE.DoubleSide,
});

/** Meshes of a scene, with materials that reflect evenly, and its camera. */
export function stage({ objects, camera: { from, to, fov } }) {
  const meshes = objects.map(({ name, mesh }) => {
    const geometry = new THREE.BufferGeometry();
    for (const [attribute, values, size] of [['position', mesh.positions, 3], ['normal', mesh.normals, 3], ['uv', mesh.texcoords, 2]])
      geometry.setAttribute(attribute, new THREE.Float32BufferAttribute(values, size));
    geometry.setIndex(mesh.indices);
    const result = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ side: THREE.DoubleSide }));
    Object.assign(result, { name, castShadow: true, receiveShadow: true });
    return result;
  });
  const camera = new THREE.PerspectiveCamera(fov, WIDTH / HEIGHT, 0.05, 50);
  camera.position.set(...from);
  camera.lookAt(...to);
  camera.updateMatrixWorld();
  return { meshes, floor: meshes.find(({ name }) => name === 'floor'), camera, scene: new THREE.Scene().add(...meshes) };
}

const target = new THREE.WebGLRenderTarget(WIDTH, HEIGHT, { type: THREE.FloatType });

/** Red, green, blue, alpha of every pixel, without a tone curve. */
export function pixelsOf(scene, camera) {
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * WIDTH * HEIGHT);
  renderer.readRenderTargetPixels(target, 0, 0, WIDTH, HEIGHT, pixels);
  renderer.setRenderTarget(null);
  return pixels;
}

/** Per pixel the place of the floor that it shows; null where it shows another thing. */
export function placesOf({ scene, floor, meshes, camera }) {
  scene.overrideMaterial = PLACE;
  const all = pixelsOf(scene, camera);
  for (const mesh of meshes) mesh.visible = mesh === floor;
  const alone = pixelsOf(scene, camera);
  return Array.from({ length: WIDTH * HEIGHT }, (_, i) => {
    const [seen, place] = [all, alone].map((of) => Array.from(of.subarray(4 * i, 4 * i + 4)));
    return place[3] === 1 && place.every((x, axis) => x === seen[axis]) ? place.slice(0, 3) : null;
  });
}

/** The address of a PNG of pictures one below the other, each of shares from 0 to 1, dark blue where there is none. */
export function pictureOf(stack) {
  const canvas = Object.assign(document.createElement('canvas'), { width: WIDTH, height: HEIGHT * stack.length });
  const context = canvas.getContext('2d');
  stack.forEach((shares, row) => {
    const image = new ImageData(WIDTH, HEIGHT);
    shares.forEach((share, i) => {
      const [x, y] = [i % WIDTH, HEIGHT - 1 - Math.floor(i / WIDTH)];
      const grey = Math.round(255 * Math.min(1, share ?? 0));
      image.data.set(share === null ? [25, 30, 60, 255] : [grey, grey, grey, 255], 4 * (x + WIDTH * y));
    });
    context.putImageData(image, 0, row * HEIGHT);
  });
  return canvas.toDataURL();
}

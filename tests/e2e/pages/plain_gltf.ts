// SPDX-License-Identifier: Apache-2.0
//
// Opens /pack.glb as any page with three.js would, and says how many triangles were drawn.
import { Box3, PerspectiveCamera, Scene, Sphere, WebGLRenderer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const renderer = new WebGLRenderer();
const gltf = await new GLTFLoader().loadAsync('pack.glb');
const { center, radius } = new Box3().setFromObject(gltf.scene).getBoundingSphere(new Sphere());
const camera = new PerspectiveCamera(50, 16 / 9, radius / 100, 10 * radius);
camera.position.set(center.x, center.y, center.z + 3 * radius);
renderer.render(new Scene().add(gltf.scene), camera);
Object.assign(globalThis, { triangles: renderer.info.render.triangles });

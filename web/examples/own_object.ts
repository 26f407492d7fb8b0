// SPDX-License-Identifier: Apache-2.0
//
// An object of one's own in a pack's light (Figure 3 of RR-6983): the knot is not in the pack, was not there when the light
// was baked, and is lit by it wherever it goes.
import { Mesh, MeshStandardMaterial, PerspectiveCamera, Scene, TorusKnotGeometry, Vector3, WebGLRenderer } from 'three';
import { LightwellLoader } from 'lightwell/three';

const renderer = new WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);

const pack = new URLSearchParams(location.search).get('pack') ?? 'pack.lw.glb';
const room = await new LightwellLoader().setRenderer(renderer).loadAsync(pack);
const scene = new Scene().add(room);
for (const lamp of room.lamps) lamp.visible = false;

const size = room.bounds.getSize(new Vector3());
const center = room.bounds.getCenter(new Vector3());
const radius = 0.1 * Math.min(...size.toArray());
const knot = new Mesh(new TorusKnotGeometry(radius, 0.35 * radius, 160, 24), new MeshStandardMaterial({ roughness: 1 }));
scene.add(knot);

const camera = new PerspectiveCamera(45, innerWidth / innerHeight, 0.01 * radius, 100 * size.length());
camera.position.copy(center).add(new Vector3(0, 0, 0.95 * size.z));
camera.lookAt(center);

let place = 0.5;
let request = 0;

/** Puts the knot at a place across the room, 0 left ... 1 right, and draws. */
function draw(place: number): void {
  request = 0;
  knot.position.copy(center);
  knot.position.x = room.bounds.min.x + (0.15 + 0.7 * place) * size.x;
  renderer.render(scene, camera);
}

/** Asks for one frame, however much has changed. */
function invalidate(): void {
  if (request === 0) request = requestAnimationFrame(() => draw(place));
}

room.addEventListener('change', invalidate);
room.addEventListener('complete', () => (document.title = 'complete'));
addEventListener('pointermove', (event) => {
  place = event.clientX / innerWidth;
  invalidate();
});
draw(place);

Object.assign(globalThis, { LightwellLoader, room, scene, knot, camera, renderer, draw });

// SPDX-License-Identifier: Apache-2.0
import { type Camera, type PerspectiveCamera, Sphere, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { LightwellScene } from '../three/scene.js';

const TURN = Math.PI / 36;
const STEP = 20;
const ZOOM = 0.95;

/** Where the camera is: it looks from `spherical` around `target` at `target`. Radians and metres. */
export interface View {
  theta: number;
  phi: number;
  radius: number;
  target: [number, number, number];
}

/** A camera that circles a target, moved by mouse, touch and keyboard. */
export class Orbit {
  readonly #camera: PerspectiveCamera;
  readonly #controls: OrbitControls;
  readonly #canvas: HTMLCanvasElement;
  readonly #changed: () => void;

  constructor(camera: PerspectiveCamera, canvas: HTMLCanvasElement, changed: () => void) {
    this.#camera = camera;
    this.#canvas = canvas;
    this.#changed = changed;
    this.#controls = new OrbitControls(camera, canvas);
    this.#controls.enableDamping = true;
    this.#controls.zoomToCursor = true;
    this.#controls.addEventListener('change', changed);
    canvas.addEventListener('keydown', (event) => this.#key(event));
    canvas.addEventListener('dblclick', () => this.#enabled && this.reset());
  }

  get #enabled(): boolean {
    return this.#controls.enabled;
  }

  set enabled(enabled: boolean) {
    this.#controls.enabled = enabled;
    this.#canvas.style.touchAction = enabled ? 'none' : 'auto';
    this.#canvas.tabIndex = enabled ? 0 : -1;
  }

  get view(): View {
    const offset = this.#camera.position.clone().sub(this.#controls.target);
    const { theta, phi, radius } = new Spherical().setFromVector3(offset);
    return { theta, phi, radius, target: this.#controls.target.toArray() };
  }

  set view({ theta, phi, radius, target }: View) {
    this.#controls.target.set(...target);
    this.#camera.position.setFromSpherical(new Spherical(radius, phi, theta)).add(this.#controls.target);
    this.#controls.update();
    this.#changed();
  }

  /** Makes the present view the one to which `reset` returns. */
  save(): void {
    this.#controls.saveState();
  }

  reset(): void {
    this.#controls.reset();
  }

  /** Lets a movement run out. */
  update(seconds: number): void {
    this.#controls.update(seconds);
  }

  dispose(): void {
    this.#controls.dispose();
  }

  /** Looks through the pack's first camera, or else at the whole pack; the clipping planes fit its size. */
  frame(pack: LightwellScene, fieldOfView: number): void {
    const sphere = pack.focus.getBoundingSphere(new Sphere());
    this.#camera.near = sphere.radius / 500;
    this.#camera.far = Math.max(sphere.radius * 50, pack.bounds.getBoundingSphere(new Sphere()).radius * 4);
    this.#controls.maxDistance = sphere.radius * 20;
    this.#controls.minDistance = sphere.radius / 100;
    const packCamera = pack.opening.gltf.cameras[0];
    if (packCamera === undefined) this.#frameWhole(sphere, fieldOfView);
    else this.#lookThrough(packCamera, sphere);
    this.#camera.updateProjectionMatrix();
    this.#controls.update();
    this.save();
  }

  #frameWhole({ center, radius }: Sphere, fieldOfView: number): void {
    const distance = (1.1 * radius) / Math.sin((fieldOfView * Math.PI) / 360);
    this.view = { theta: Math.PI / 6, phi: (75 * Math.PI) / 180, radius: distance, target: center.toArray() };
  }

  /** The target lies on the camera's axis, where that passes the middle of the pack. */
  #lookThrough(camera: Camera, { center, radius }: Sphere): void {
    camera.updateWorldMatrix(true, false);
    camera.getWorldPosition(this.#camera.position);
    const axis = camera.getWorldDirection(new Vector3());
    const depth = Math.max(center.clone().sub(this.#camera.position).dot(axis), radius / 4);
    this.#controls.target.copy(this.#camera.position).addScaledVector(axis, depth);
  }

  #key(event: KeyboardEvent): void {
    if (!this.#enabled || event.altKey || event.ctrlKey || event.metaKey) return;
    const action = (event.shiftKey ? MOVES : TURNS)[event.key] ?? OTHERS[event.key];
    if (action === undefined) return;
    action(this.#controls);
    this.#changed();
    event.preventDefault();
  }
}

type Keys = Record<string, (controls: OrbitControls) => void>;

const TURNS: Keys = {
  ArrowLeft: (controls) => controls.rotateLeft(TURN),
  ArrowRight: (controls) => controls.rotateLeft(-TURN),
  ArrowUp: (controls) => controls.rotateUp(TURN),
  ArrowDown: (controls) => controls.rotateUp(-TURN),
};

const MOVES: Keys = {
  ArrowLeft: (controls) => controls.pan(STEP, 0),
  ArrowRight: (controls) => controls.pan(-STEP, 0),
  ArrowUp: (controls) => controls.pan(0, STEP),
  ArrowDown: (controls) => controls.pan(0, -STEP),
};

const OTHERS: Keys = {
  '+': (controls) => controls.dollyIn(ZOOM),
  '=': (controls) => controls.dollyIn(ZOOM),
  '-': (controls) => controls.dollyOut(ZOOM),
  Home: (controls) => controls.reset(),
};

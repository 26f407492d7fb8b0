// SPDX-License-Identifier: Apache-2.0
import { type Box3, type Camera, type PerspectiveCamera, Sphere, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { LightwellScene } from '../three/scene.js';

const TURN = Math.PI / 36;
const STEP = 20;
const ZOOM = 0.95;
/** Of a glide so much is left after a second. */
const GLIDE = 0.05;
/** Around what is shown whole. */
const MARGIN = 1.1;
/** The first frame of a movement: the one before it was drawn long ago. Seconds. */
const FIRST_FRAME = 1 / 60;

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
  /** The radius of what is looked at. */
  #size = 1;
  /** Every swipe and every turn of the wheel is the camera's; else the page keeps those that scroll it. */
  #always = false;
  /** Where a finger began, until it has gone sideways or another one has joined it. */
  #swipe: PointerEvent | null = null;
  /** Since the last frame. */
  #moved = false;
  #moving = false;
  #time = 0;

  constructor(camera: PerspectiveCamera, canvas: HTMLCanvasElement, changed: () => void) {
    this.#camera = camera;
    this.#canvas = canvas;
    this.#changed = changed;
    // Before the controls, which take every turn of the wheel.
    canvas.addEventListener('wheel', (event) => this.#always || canvas.matches(':focus') || event.stopImmediatePropagation());
    this.#controls = new OrbitControls(camera, canvas);
    this.#controls.zoomToCursor = true;
    this.#controls.addEventListener('change', () => this.#change());
    canvas.addEventListener('keydown', (event) => this.#key(event));
    canvas.addEventListener('pointerdown', (event) => (this.#swipe = event.pointerType === 'touch' && event.isPrimary ? event : null));
    canvas.addEventListener('pointermove', (event) => this.#scrolls(event) && event.stopPropagation());
    // A browser scrolls by two fingers where it scrolls by one, unless it is told not to by the first of their moves.
    canvas.addEventListener('touchmove', (event) => event.touches.length > 1 && this.#enabled && event.preventDefault(), {
      passive: false,
    });
  }

  get #enabled(): boolean {
    return this.#controls.enabled;
  }

  /**
   * Whether and how the visitor moves the camera, as `camera-controls` says it. Unless "always", a swipe up or down and the wheel scroll
   * the page: a finger turns the scene when it begins sideways, two fingers move it, and the wheel zooms while the canvas has the
   * focus, as after a click. Who walks does not circle.
   */
  allow(mode: string | null): void {
    const enabled = (this.#controls.enabled = mode !== null && mode !== 'walk');
    this.#always = mode === 'always';
    this.#canvas.style.touchAction = !enabled ? 'auto' : this.#always ? 'none' : 'pan-y';
    this.#canvas.tabIndex = enabled ? 0 : -1;
  }

  get view(): View {
    const offset = this.#camera.position.clone().sub(this.#controls.target);
    const { theta, phi, radius } = new Spherical().setFromVector3(offset);
    return { theta, phi, radius, target: this.#controls.target.toArray() };
  }

  /** Any distance is right here: the limits are the visitor's. */
  set view({ theta, phi, radius, target }: View) {
    this.#stop();
    this.#controls.target.set(...target);
    this.#camera.position.setFromSpherical(new Spherical(radius, phi, theta)).add(this.#controls.target);
    this.#place();
  }

  /** Makes the present view the one to which `reset` returns. */
  save(): void {
    this.#controls.saveState();
  }

  reset(): void {
    this.#stop();
    this.#controls.reset();
  }

  /**
   * Moves on to a frame's time, in milliseconds, and says whether it moved since the last one. A glide takes as long with few frames as
   * with many.
   */
  update(time: number): boolean {
    const seconds = this.#moving ? Math.max(0, time - this.#time) / 1000 : FIRST_FRAME;
    this.#time = time;
    this.#controls.enableDamping = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.#controls.dampingFactor = 1 - GLIDE ** seconds;
    this.#controls.update();
    this.#moving = this.#moved;
    this.#moved = false;
    return this.#moving;
  }

  /** Whether it moves from frame to frame, or is about to. */
  get moving(): boolean {
    return this.#moving || this.#moved;
  }

  /** Ends a glide, for what follows at once. */
  #stop(): void {
    this.#controls.enableDamping = false;
    this.#controls.update();
  }

  dispose(): void {
    this.#controls.dispose();
  }

  /** Shows a pack from where its file's camera stands or, where there is none, all of it: `reset` returns there. */
  frame(pack: LightwellScene, camera: Camera | undefined): void {
    const { center, radius } = sphereOf(pack);
    this.#size = radius;
    this.#camera.far = Math.max(radius * 50, pack.bounds.getBoundingSphere(new Sphere()).radius * 4);
    this.#controls.maxDistance = radius * 20;
    this.#controls.minDistance = radius / 100;
    if (camera) this.lookThrough(camera, pack);
    else this.view = { theta: Math.PI / 6, phi: (75 * Math.PI) / 180, radius: 3 * radius, target: center.toArray() };
    // An overview fits a square: a narrow canvas shows more up and down.
    if (!camera || (camera.name === 'overview' && this.#camera.aspect < 1)) this.#approach(pack.focus);
    this.save();
  }

  /** Shows all of a box whose middle is looked at, from as near as can be, unless it is seen from inside. */
  #approach(box: Box3): void {
    const { matrixWorldInverse, projectionMatrix } = this.#camera;
    if (box.containsPoint(this.#camera.position)) return;
    this.#camera.updateMatrixWorld();
    const [slopeX, , , , , slopeY] = projectionMatrix.elements;
    const ends = [box.min, box.max];
    let nearer = Infinity;
    for (let i = 0; i < 8; i++) {
      const { x, y, z } = new Vector3(ends[i & 1]!.x, ends[(i >> 1) & 1]!.y, ends[i >> 2]!.z).applyMatrix4(matrixWorldInverse);
      nearer = Math.min(nearer, -z - MARGIN * Math.max(slopeX! * Math.abs(x), slopeY! * Math.abs(y)));
    }
    this.view = { ...this.view, radius: this.view.radius - nearer };
  }

  /** The target lies on the camera's axis, where that passes the middle of the pack. */
  lookThrough(camera: Camera, pack: LightwellScene): void {
    const { center, radius } = sphereOf(pack);
    this.#stop();
    camera.updateWorldMatrix(true, false);
    camera.getWorldPosition(this.#camera.position);
    const axis = camera.getWorldDirection(new Vector3());
    const depth = Math.max(center.clone().sub(this.#camera.position).dot(axis), radius / 4);
    this.#controls.target.copy(this.#camera.position).addScaledVector(axis, depth);
    this.#place();
  }

  /** Lets the camera stay where it was put, and see from there. */
  #place(): void {
    const controls = this.#controls;
    const distance = controls.getDistance();
    controls.maxDistance = Math.max(controls.maxDistance, distance);
    controls.minDistance = Math.min(controls.minDistance, distance);
    this.#camera.far = Math.max(this.#camera.far, 3 * distance);
    controls.update();
    this.#change();
  }

  /** What is near a camera that is far away may be clipped: depths have so many bits. */
  #change(): void {
    this.#moved = true;
    this.#camera.near = Math.max(this.#size, this.#controls.getDistance()) / 500;
    this.#camera.updateProjectionMatrix();
    this.#changed();
  }

  /** Whether a move belongs to a swipe up or down: the browser says so only after some of them. */
  #scrolls({ clientX, clientY }: PointerEvent): boolean {
    const from = this.#swipe;
    if (from === null || this.#always || Math.abs(clientX - from.clientX) > Math.abs(clientY - from.clientY)) this.#swipe = null;
    return this.#swipe !== null;
  }

  #key(event: KeyboardEvent): void {
    if (!this.#enabled || event.altKey || event.ctrlKey || event.metaKey) return;
    const action = (event.shiftKey ? MOVES : TURNS)[event.key] ?? OTHERS[event.key];
    if (event.key === 'Home') this.reset();
    else if (action === undefined) return;
    else action(this.#controls);
    this.#change();
    event.preventDefault();
  }
}

const sphereOf = ({ focus }: LightwellScene) => focus.getBoundingSphere(new Sphere());

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
};

// SPDX-License-Identifier: Apache-2.0
//
// Walking through a pack at eye height, while the element's attribute says camera-controls="walk".
import type { Camera, Vector3 } from 'three';
import type { LightwellView } from './lightwell_view.js';
import { nearestHit } from './pick.js';
import { createStick } from './stick.js';

/** Of a grown-up, in metres; in a scene that is lower than two of them all of this is as much smaller. */
const EYE_HEIGHT = 1.65;
const SPEED = 1.5;
/** From the body's middle to where it touches walls. */
const GIRTH = 0.3;
/** What is met at a slant is looked for so many times as far. */
const SLANT = 4;
/** Up steps lower than this, and down again, the eye follows at CLIMB metres a second. */
const STEP = 0.5;
const CLIMB = 3;
const RUN = 2.5;
/** Radians a second by key, and for a drag across the height of the picture. */
const TURN = 1.5;
const LOOK = 2;
/** No frame counts for more, in seconds: nobody walks through a wall while the page was busy. */
const LONGEST_FRAME = 0.1;

/** What each key adds: to the right, ahead, and to the left in turning. */
const KEYS: Record<string, readonly [number, number, number]> = {
  KeyW: [0, 1, 0],
  KeyS: [0, -1, 0],
  KeyA: [-1, 0, 0],
  KeyD: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  ArrowLeft: [0, 0, 1],
  ArrowRight: [0, 0, -1],
};

/** What ends the walk in each element. */
const walks = new WeakMap<LightwellView, AbortController>();

/** Lets the visitor walk in the pack that an element shows, from where the camera is, until its attribute says something else. */
export function walk(view: LightwellView): void {
  walks.get(view)?.abort();
  const canvas = view.shadowRoot!.querySelector<HTMLCanvasElement>('canvas:not(.poster)');
  if (canvas === null || !wantsWalk(view)) return;
  const end = new AbortController();
  walks.set(view, end);
  const { signal } = end;
  const walker = new Walker(view, canvas);
  const stick = createStick((right, ahead) => walker.push(right, ahead));
  const watch = new MutationObserver(() => wantsWalk(view) || end.abort());
  watch.observe(view, { attributeFilter: ['camera-controls'] });
  canvas.tabIndex = 0;
  canvas.style.touchAction = 'none';
  if (matchMedia('(pointer: coarse)').matches) canvas.after(stick);
  canvas.addEventListener('keydown', (event) => walker.press(event), { signal });
  canvas.addEventListener('keyup', ({ code }) => walker.release(code), { signal });
  canvas.addEventListener('blur', () => walker.stop(), { signal });
  canvas.addEventListener('pointerdown', ({ pointerId }) => canvas.setPointerCapture(pointerId), { signal });
  canvas.addEventListener('pointermove', (event) => walker.look(event), { signal });
  signal.addEventListener('abort', () => {
    walker.stop();
    watch.disconnect();
    stick.remove();
  });
}

const wantsWalk = (view: LightwellView) => view.getAttribute('camera-controls') === 'walk';

class Walker {
  readonly #view: LightwellView;
  readonly #canvas: HTMLCanvasElement;
  readonly #keys = new Set<string>();
  #running = false;
  #stick: readonly [number, number] = [0, 0];
  #time = 0;
  #frame = 0;

  constructor(view: LightwellView, canvas: HTMLCanvasElement) {
    this.#view = view;
    this.#canvas = canvas;
  }

  press(event: KeyboardEvent): void {
    if (KEYS[event.code] === undefined || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    this.#running = event.shiftKey;
    this.#keys.add(event.code);
    this.#start();
  }

  release(code: string): void {
    this.#keys.delete(code);
  }

  /** The stick of a touch screen: each from -1 to 1. */
  push(right: number, ahead: number): void {
    this.#stick = [right, ahead];
    this.#start();
  }

  stop(): void {
    this.#keys.clear();
    this.#stick = [0, 0];
  }

  /** Turns the head by a drag. */
  look({ buttons, movementX, movementY }: PointerEvent): void {
    if (buttons === 0) return;
    const scale = LOOK / this.#canvas.clientHeight;
    this.#stand(this.#view.camera.position.clone(), movementX * scale, -movementY * scale);
  }

  #start(): void {
    if (this.#frame !== 0) return;
    this.#time = performance.now();
    this.#frame = requestAnimationFrame(() => this.#step());
  }

  #step(): void {
    this.#frame = 0;
    const [right, ahead, turn] = this.#wish();
    if ((right === 0 && ahead === 0 && turn === 0) || this.#view.pack === null || !this.#canvas.isConnected) return;
    const now = performance.now();
    const seconds = Math.min(LONGEST_FRAME, (now - this.#time) / 1000);
    this.#time = now;
    this.#stand(this.#walkFrom(this.#view.camera, right, ahead, seconds), turn * TURN * seconds, 0);
    this.#frame = requestAnimationFrame(() => this.#step());
  }

  /** To the right, ahead, and turning left, of all that is pressed and pushed. */
  #wish(): [number, number, number] {
    const wish: [number, number, number] = [...this.#stick, 0];
    for (const key of this.#keys) KEYS[key]!.forEach((value, i) => (wish[i]! += value));
    return wish;
  }

  /** How large the visitor is beside a grown-up. */
  get #size(): number {
    const { min, max } = this.#view.pack!.focus;
    return Math.min(1, (max.y - min.y) / (2 * EYE_HEIGHT));
  }

  /** Where the eye is after some seconds: along walls, not through them, and as high above the floor as it should be. */
  #walkFrom({ position }: Camera, right: number, ahead: number, seconds: number): Vector3 {
    const size = this.#size;
    const { theta } = this.#view.view!;
    const way = position.clone();
    way.set(right * Math.cos(theta) - ahead * Math.sin(theta), 0, -right * Math.sin(theta) - ahead * Math.cos(theta));
    way.clampLength(0, 1).multiplyScalar(SPEED * size * seconds * (this.#running ? RUN : 1));
    const eye = position.clone().add(this.#free(position, way));
    const floor = nearestHit(this.#view.pack!, eye, way.clone().set(0, -1, 0), 3 * EYE_HEIGHT * size);
    const rise = floor === undefined ? 0 : EYE_HEIGHT * size - floor.distance;
    eye.y += Math.sign(rise) * Math.min(Math.abs(rise), CLIMB * size * seconds);
    return eye;
  }

  /** The part of a way that no wall stops: all of it, or what goes along the wall. */
  #free(eye: Vector3, way: Vector3): Vector3 {
    const wall = this.#wall(eye, way);
    if (wall === undefined) return way;
    wall.setY(0);
    if (wall.lengthSq() > 0) way.projectOnPlane(wall.normalize());
    return this.#wall(eye, way) === undefined ? way : way.set(0, 0, 0);
  }

  /** The normal of what stands in the way of the eye or of a knee. */
  #wall(eye: Vector3, way: Vector3): Vector3 | undefined {
    const size = this.#size;
    const knee = eye.clone();
    knee.y -= (EYE_HEIGHT - STEP) * size;
    return this.#stopped(eye, way, GIRTH * size) ?? this.#stopped(knee, way, GIRTH * size);
  }

  /** The normal of a surface to which a way would come nearer than `girth`. */
  #stopped(origin: Vector3, way: Vector3, girth: number): Vector3 | undefined {
    const length = way.length();
    if (length === 0) return undefined;
    const direction = way.clone().divideScalar(length);
    const hit = nearestHit(this.#view.pack!, origin, direction, length + SLANT * girth);
    const normal = hit?.face?.normal.clone().transformDirection(hit.object.matrixWorld);
    if (hit === undefined || normal === undefined) return undefined;
    return (hit.distance - length) * Math.abs(normal.dot(direction)) < girth ? normal : undefined;
  }

  /** Puts the eye somewhere and turns it, to the left and up. */
  #stand(eye: Vector3, left: number, up: number): void {
    const view = this.#view.view!;
    const theta = view.theta + left;
    const phi = Math.min(Math.PI - 0.1, Math.max(0.1, view.phi + up));
    const radius = EYE_HEIGHT * this.#size;
    const [x, y, z] = [Math.sin(phi) * Math.sin(theta), Math.cos(phi), Math.sin(phi) * Math.cos(theta)];
    this.#view.view = { theta, phi, radius, target: [eye.x - radius * x, eye.y - radius * y, eye.z - radius * z] };
  }
}

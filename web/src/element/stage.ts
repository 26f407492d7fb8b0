// SPDX-License-Identifier: Apache-2.0
import { type Camera, LinearToneMapping, NeutralToneMapping, PCFShadowMap, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { FRAME, FrameScheduler, type FrameTask } from '../three/frame_scheduler.js';

export type Tone = 'neutral' | 'none';

/** Shadows are drawn anew at most this often while geometry streams in, in milliseconds. */
const SHADOW_INTERVAL = 500;
/** Pixels of the canvas for each of the page's, at most. */
const MOST_PIXEL_RATIO = 2;
/** Frames further apart than this are not one animation, in milliseconds. */
const PAUSE = 250;
/** A camera that moves is shown with half the pixels, in width and height, when a frame takes longer than this; milliseconds. */
const SLOW_FRAME = 80;
const LEAST_SHARPNESS = 0.25;

/** A canvas with renderer, scene and camera that draws a frame only when one is asked for. */
export class Stage {
  readonly canvas = document.createElement('canvas');
  readonly renderer: WebGLRenderer;
  /** Called before a frame is drawn, with its time in milliseconds; says whether the camera is on its way. */
  beforeFrame: (time: number) => boolean = () => false;
  afterFrame: () => void = () => {};
  /** The vertical field of view of a canvas that is at least as wide as high, in degrees. */
  fieldOfView = 45;
  readonly #scheduler: FrameScheduler;
  /** Takes half of the GPU's time: the other half is for handing over what comes next, so that a slow GPU gets to the end. */
  readonly #drawing: FrameTask;
  #running = true;
  #lastFrame = -Infinity;
  #interval = Infinity;
  #moving = false;
  /** Of the canvas' full width and height; less than 1 while the camera moves and the GPU is slow. */
  #sharpness = 1;
  #shadowTime = -Infinity;
  #shadowTimer: ReturnType<typeof setTimeout> | undefined;

  /** Throws where there is no WebGL2. */
  constructor(
    readonly scene: Scene,
    readonly camera: PerspectiveCamera,
  ) {
    const context = this.canvas.getContext('webgl2', { alpha: true, antialias: true, stencil: false });
    if (context === null) throw new Error('This browser has no WebGL2, which it takes to show a 3D scene.');
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    this.#scheduler = FrameScheduler.of(this.renderer);
    this.#drawing = this.#scheduler.add(({ time }) => this.#draw(time), FRAME / 2);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => this.invalidateShadows());
    this.setTone('neutral');
  }

  /** Frames a second of the present animation, 0 while nothing moves. */
  get frameRate(): number {
    return performance.now() - this.#lastFrame > PAUSE ? 0 : 1000 / this.#interval;
  }

  setTone(tone: Tone): void {
    this.renderer.toneMapping = tone === 'neutral' ? NeutralToneMapping : LinearToneMapping;
    this.invalidate();
  }

  /** In stops. */
  setExposure(stops: number): void {
    this.renderer.toneMappingExposure = 2 ** stops;
    this.invalidate();
  }

  /** Fits the canvas to its place on the page and the field of view to the canvas: a narrow one shows no less across. */
  resize(width: number, height: number): void {
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.#setSharpness(1);
    this.camera.aspect = width / height;
    this.setFieldOfView(this.fieldOfView);
    this.draw();
  }

  /** `fieldOfView` in degrees. */
  setFieldOfView(degrees: number): void {
    this.fieldOfView = degrees;
    const slope = Math.tan((degrees * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.camera.fov = (Math.atan(slope) * 360) / Math.PI;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  /** Sees as wide as a camera of a file. */
  takeFieldOfView(camera: Camera | undefined): void {
    if (camera instanceof PerspectiveCamera) this.setFieldOfView(camera.fov);
  }

  /** Asks for a frame. */
  invalidate(): void {
    if (this.#running) this.#drawing.requestNow();
  }

  /** Asks for a frame that shows what has come: the GPU draws such frames half of the time at most. */
  invalidateSeldom(): void {
    if (this.#running) this.#drawing.request();
  }

  /** Asks for a frame with new shadows, which are drawn at most twice a second. */
  invalidateShadows(): void {
    clearTimeout(this.#shadowTimer);
    const wait = this.#shadowTime + SHADOW_INTERVAL - performance.now();
    if (wait > 0) {
      this.#shadowTimer = setTimeout(() => this.invalidateShadows(), wait);
      return;
    }
    this.#shadowTime = performance.now();
    this.renderer.shadowMap.needsUpdate = true;
    this.invalidateSeldom();
  }

  /** While stopped, only `draw` and `resize` draw; a frame is drawn at the start, whatever was asked for meanwhile. */
  setRunning(running: boolean): void {
    this.#running = running;
    if (running) this.invalidate();
    else this.#drawing.cancel();
  }

  /** Draws a frame now. */
  draw(): void {
    this.#drawing.run();
  }

  /** Shows all pixels again: the camera rests. */
  sharpen(): void {
    if (this.#sharpness === 1) return;
    this.#setSharpness(1);
    this.invalidate();
  }

  #setSharpness(sharpness: number): void {
    this.#sharpness = sharpness;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, MOST_PIXEL_RATIO) * sharpness);
  }

  #draw(time: number): void {
    const interval = time - this.#lastFrame;
    this.#interval = interval > PAUSE || this.#interval === Infinity ? interval : 0.9 * this.#interval + 0.1 * interval;
    this.#lastFrame = time;
    const moved = this.#moving;
    this.#moving = this.beforeFrame(time);
    const slow = moved && this.#moving && interval > SLOW_FRAME;
    if (slow && this.#sharpness > LEAST_SHARPNESS) this.#setSharpness(this.#sharpness / 2);
    this.renderer.render(this.scene, this.camera);
    this.afterFrame();
  }

  /** Draws a frame now, shadows and all, and calls back when the GPU has done that. */
  finish(then: () => void): void {
    clearTimeout(this.#shadowTimer);
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
    this.#scheduler.whenDone(then);
  }

  dispose(): void {
    this.#drawing.dispose();
    clearTimeout(this.#shadowTimer);
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

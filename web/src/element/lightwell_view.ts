// SPDX-License-Identifier: Apache-2.0
import type { Camera, Scene } from 'three';
import type { ConnectionEvent, FailureEvent, Progress, Strategy } from '../core/protocol.js';
import { LightwellLoader } from '../three/loader.js';
import { messageOf, reasonOf } from '../three/pack_error.js';
import type { LightwellScene } from '../three/scene.js';
import { parseQuantity, parseTriple, parseWord } from './attributes.js';
import { Orbit, type View } from './orbit.js';
import { Stage } from './stage.js';

/** The element's events by name, with what their `detail` holds. */
export interface LightwellViewDetails {
  load: null;
  firstframe: null;
  progress: Progress;
  connection: { state: ConnectionEvent['state'] };
  complete: null;
  'camera-change': View;
  error: { reason: FailureEvent['reason'] | 'unsupported'; message: string };
}

const LIGHTS = ['all', 'off', 'direct', 'indirect'] as const;
const STRATEGIES = ['interleave', 'geometry', 'light'] as const;
const TONES = ['neutral', 'none'] as const;
const DEFAULT_LABEL = '3D scene. Arrow keys turn it, shift and arrow keys move it, plus and minus zoom, Home returns.';
/** Pause before a file that was replaced is read anew, in milliseconds; it doubles with each time, up to the longest. */
const REPLACED_PAUSE = 1000;
const LONGEST_REPLACED_PAUSE = 60_000;
/** The stream is told the view once that has rested for so long, in milliseconds. */
const VIEW_REST = 150;

const STYLE = `
  :host { display: block; position: relative; min-width: 1px; min-height: 150px; contain: content; }
  :host([hidden]) { display: none; }
  canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; outline-offset: -2px; }
  img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: cover; transition: opacity 0.4s; }
  img.gone { opacity: 0; pointer-events: none; }
`;

/**
 * `<lightwell-view src="room.lw.glb" camera-controls>` shows a pack.
 *
 * Attributes: `src`, `poster` (a picture until the first frame), `loading` ("auto" and "eager" at once, "lazy" when it comes
 * near the screen), `camera-controls`, `camera-orbit` ("30deg 75deg 4m": azimuth, angle from the vertical, distance),
 * `camera-target` ("0m 1m 0m"), `field-of-view` ("45deg"), `exposure` (stops; by default the pack's), `light` ("all", "off",
 * "direct", "indirect"), `tone` ("neutral", "none"), `strategy` ("interleave", "geometry", "light"), `wireframe`.
 *
 * Events: `load` when the scene is there, `firstframe`, `progress` (detail: geometry, light, bytes, rate ...), `connection`
 * (detail.state: "streaming", "waiting", "complete"), `complete`, `camera-change`, `error` (detail: reason, message).
 */
export class LightwellView extends HTMLElement {
  static readonly observedAttributes = [
    'src',
    'poster',
    'loading',
    'camera-controls',
    'camera-orbit',
    'camera-target',
    'field-of-view',
    'exposure',
    'light',
    'tone',
    'strategy',
    'wireframe',
    'aria-label',
  ];

  #stage: Stage | null = null;
  #orbit: Orbit | null = null;
  #pack: LightwellScene | null = null;
  #poster: HTMLImageElement | null = null;
  /** Of the pack that is loading or shown; null when none is. */
  #loader: LightwellLoader | null = null;
  #replacedPause = REPLACED_PAUSE;
  #near = false;
  #paused = false;
  #complete = false;
  #firstFrame = false;
  #progress: Progress | null = null;
  #wantedView: View | null = null;
  #viewTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #resize = new ResizeObserver(() => this.#stage?.resize(this.clientWidth, this.clientHeight));
  readonly #intersection = new IntersectionObserver((entries) => this.#onIntersection(entries.at(-1)!.isIntersecting), {
    rootMargin: '100px',
  });

  /** The three.js scene, for objects of the page's own; call `invalidate` after a change. */
  get scene(): Scene | null {
    return this.#stage?.scene ?? null;
  }

  get camera(): Camera | null {
    return this.#stage?.camera ?? null;
  }

  /** The pack, once it is there. */
  get pack(): LightwellScene | null {
    return this.#pack;
  }

  get loaded(): boolean {
    return this.#pack !== null;
  }

  /** Whether everything has come and is shown. */
  get complete(): boolean {
    return this.#complete;
  }

  get progress(): Progress | null {
    return this.#progress;
  }

  /** Frames a second, 0 while nothing moves. */
  get frameRate(): number {
    return this.#stage?.frameRate ?? 0;
  }

  get view(): View | null {
    return this.#orbit?.view ?? null;
  }

  /** Where the camera is; may be set before the pack is there. */
  set view(view: View) {
    if (this.#pack === null) this.#wantedView = view;
    else if (this.#orbit !== null) this.#orbit.view = view;
  }

  /** Draws a frame now, in the caller's turn. */
  draw(): void {
    this.#stage?.draw();
  }

  /** Asks for a frame with new shadows: call it after a change of the scene. */
  invalidate(): void {
    this.#stage?.invalidateShadows();
  }

  /** Asks for no more bytes until `resume`. */
  pause(): void {
    this.#paused = true;
    this.#pauseOrResume();
  }

  resume(): void {
    this.#paused = false;
    this.#pauseOrResume();
  }

  /** The present picture. */
  toDataURL(type?: string, quality?: number): string {
    if (this.#stage === null) throw new Error('lightwell-view: not part of a page');
    this.#stage.draw();
    return this.#stage.canvas.toDataURL(type, quality);
  }

  connectedCallback(): void {
    const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
    const style = document.createElement('style');
    style.textContent = STYLE;
    root.replaceChildren(style);
    const stage = this.#createStage();
    if (stage === null) return this.#apply('poster');
    this.#stage = stage;
    this.#orbit = new Orbit(stage.camera, stage.canvas, () => this.#onView());
    stage.beforeFrame = (seconds) => this.#orbit?.update(seconds);
    stage.afterFrame = () => this.#onFrame();
    root.append(stage.canvas);
    this.#resize.observe(this);
    this.#intersection.observe(this);
    for (const name of LightwellView.observedAttributes) if (name !== 'src' && name !== 'loading') this.#apply(name);
    this.#open();
  }

  /** Null where the browser cannot draw; the error event follows a turn later, when the page can listen. */
  #createStage(): Stage | null {
    try {
      return new Stage();
    } catch (error) {
      setTimeout(() => this.#emit('error', { reason: 'unsupported', message: messageOf(error) }));
      return null;
    }
  }

  disconnectedCallback(): void {
    this.#resize.disconnect();
    this.#intersection.disconnect();
    clearTimeout(this.#viewTimer);
    this.#unload();
    this.#orbit?.dispose();
    this.#stage?.dispose();
    this.#stage = this.#orbit = null;
  }

  attributeChangedCallback(name: string): void {
    if (this.#stage === null) return;
    if (name === 'src') this.#open();
    else this.#apply(name);
  }

  /** Listens to one of the element's own events; gives its detail. */
  on<Name extends keyof LightwellViewDetails>(name: Name, listener: (detail: LightwellViewDetails[Name]) => void): void {
    this.addEventListener(name, (event) => event instanceof CustomEvent && listener(event.detail as LightwellViewDetails[Name]));
  }

  #open(): void {
    this.#replacedPause = REPLACED_PAUSE;
    this.#load();
  }

  #load(): void {
    this.#unload();
    const src = this.getAttribute('src');
    const stage = this.#stage;
    if (src === null || stage === null || (this.getAttribute('loading') === 'lazy' && !this.#near)) return;
    const strategy: Strategy = parseWord(this.getAttribute('strategy'), STRATEGIES);
    const loader = (this.#loader = new LightwellLoader());
    const current = () => loader === this.#loader;
    const onConnection = (state: ConnectionEvent['state']) => current() && this.#emit('connection', { state });
    loader.setRenderer(stage.renderer).setOptions({ strategy, onConnection }).load(
      src,
      (pack) => this.#show(pack),
      undefined,
      (error) => current() && this.#onFailure(reasonOf(error), messageOf(error)),
    );
  }

  #unload(): void {
    this.#loader?.abort();
    this.#loader = null;
    this.#pack?.removeFromParent();
    this.#pack?.dispose();
    this.#pack = this.#progress = null;
    this.#complete = this.#firstFrame = false;
    this.#stage?.invalidate();
  }

  #show(pack: LightwellScene): void {
    const stage = this.#stage!;
    this.#pack = pack;
    pack.addEventListener('change', () => stage.invalidateSeldom());
    pack.addEventListener('geometry', () => stage.invalidateShadows());
    pack.addEventListener('progress', ({ progress }) => {
      this.#progress = progress;
      this.#emit('progress', progress);
    });
    pack.addEventListener('connection', ({ state }) => this.#emit('connection', { state }));
    pack.addEventListener('failure', ({ reason, message }) => this.#onFailure(reason, message));
    pack.addEventListener('complete', () => stage.finish(() => pack === this.#pack && this.#onComplete()));
    stage.scene.add(pack);
    this.#pauseOrResume();
    for (const name of ['field-of-view', 'exposure', 'light', 'wireframe']) this.#apply(name);
    this.#frame(pack);
    stage.invalidateShadows();
    this.#emit('load', null);
  }

  /** A file that was replaced is another pack: what has come of the old one is of no use. */
  #onFailure(reason: FailureEvent['reason'], message: string): void {
    this.#emit('error', { reason, message });
    if (reason !== 'replaced') return;
    const loader = this.#loader;
    setTimeout(() => loader === this.#loader && this.#load(), this.#replacedPause);
    this.#replacedPause = Math.min(2 * this.#replacedPause, LONGEST_REPLACED_PAUSE);
  }

  #frame(pack: LightwellScene): void {
    const stage = this.#stage!;
    const orbit = this.#orbit!;
    const camera = pack.opening.gltf.cameras[0] as { fov?: number } | undefined;
    if (camera?.fov !== undefined && !this.hasAttribute('field-of-view')) stage.setFieldOfView(camera.fov);
    orbit.frame(pack, stage.fieldOfView);
    this.#apply('camera-orbit');
    if (this.#wantedView !== null) orbit.view = this.#wantedView;
    this.#wantedView = null;
  }

  #apply(name: string): void {
    const stage = this.#stage!;
    const value = this.getAttribute(name);
    switch (name) {
      case 'poster':
        return this.#setPoster(value);
      case 'loading':
        return this.#loader === null ? this.#open() : undefined;
      case 'camera-controls':
        this.#orbit!.enabled = value !== null;
        return;
      case 'camera-orbit':
      case 'camera-target':
        return this.#setCamera();
      case 'field-of-view':
        return value === null ? undefined : stage.setFieldOfView(((parseQuantity(value) ?? Math.PI / 4) * 180) / Math.PI);
      case 'exposure':
        return stage.setExposure(parseQuantity(value ?? '') ?? this.#pack?.exposure ?? 0);
      case 'light':
        return this.#setLight(parseWord(value, LIGHTS));
      case 'tone':
        return stage.setTone(parseWord(value, TONES));
      case 'strategy':
        return this.#pack?.setStrategy(parseWord(value, STRATEGIES));
      case 'wireframe':
        return this.#pack?.setWireframe(value !== null);
      case 'aria-label':
        stage.canvas.setAttribute('role', 'img');
        stage.canvas.setAttribute('aria-label', value ?? DEFAULT_LABEL);
    }
  }

  #setCamera(): void {
    if (this.#pack === null) return;
    const orbit = this.#orbit!;
    const [theta, phi, radius] = parseTriple(this.getAttribute('camera-orbit')) ?? [];
    const target = parseTriple(this.getAttribute('camera-target'));
    if (theta === undefined && target === null) return;
    const now = orbit.view;
    orbit.view = { theta: theta ?? now.theta, phi: phi ?? now.phi, radius: radius ?? now.radius, target: target ?? now.target };
    orbit.save();
  }

  #setLight(light: (typeof LIGHTS)[number]): void {
    for (const grid of this.#pack?.grids ?? []) grid.visible = light === 'all' || light === 'indirect';
    for (const lamp of this.#pack?.lamps ?? []) lamp.visible = light === 'all' || light === 'direct';
    this.#stage!.invalidateShadows();
  }

  #setPoster(url: string | null): void {
    this.#poster?.remove();
    this.#poster = null;
    if (url === null || this.#firstFrame) return;
    this.#poster = document.createElement('img');
    this.#poster.alt = '';
    this.#poster.src = url;
    this.shadowRoot!.append(this.#poster);
  }

  #onIntersection(near: boolean): void {
    this.#near = near;
    this.#stage?.setRunning(near);
    if (near && this.#loader === null && this.getAttribute('loading') === 'lazy') this.#open();
    this.#pauseOrResume();
  }

  /** Asks for nothing that is not about to be seen. */
  #pauseOrResume(): void {
    if (this.#paused || !this.#near) this.#pack?.pause();
    else this.#pack?.resume();
  }

  #onFrame(): void {
    if (this.#firstFrame || this.#pack === null) return;
    this.#firstFrame = true;
    this.#poster?.classList.add('gone');
    this.#emit('firstframe', null);
  }

  #onComplete(): void {
    this.#complete = true;
    this.#emit('complete', null);
  }

  #onView(): void {
    this.#stage?.invalidate();
    clearTimeout(this.#viewTimer);
    this.#viewTimer = setTimeout(() => {
      if (this.#stage === null || this.#pack === null) return;
      this.#pack.setView(this.#stage.camera, this.#stage.canvas.height);
      this.#emit('camera-change', this.#orbit!.view);
    }, VIEW_REST);
  }

  #emit<Name extends keyof LightwellViewDetails>(name: Name, detail: LightwellViewDetails[Name]): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}

// SPDX-License-Identifier: Apache-2.0
import { DirectionalLight, PerspectiveCamera, Scene } from 'three';
import type { ConnectionEvent, Progress, Strategy } from '../core/protocol.js';
import { LightwellLoader } from '../three/loader.js';
import { messageOf, reasonOf } from '../three/pack_error.js';
import type { LightwellScene } from '../three/scene.js';
import { DRAWN_ATTRIBUTES, LIGHTS, LOOKUPS, parseQuantity, parseView, parseWord, SHADOWS, STRATEGIES, TONES } from './attributes.js';
import { type ContextHolder, dropContext, serveContexts, wantContext } from './contexts.js';
import type { LightwellViewDetails, Listens } from './events.js';
import { cameraNamed, cameraNames } from './file_cameras.js';
import { Orbit, type View } from './orbit.js';
import { Overlay } from './overlay.js';
import { Stage } from './stage.js';

const DEFAULT_LABEL = '3D scene. Arrow keys turn it, shift and arrow keys move it, plus and minus zoom, Home returns.';
/** Where there is no document, as on a server that makes pages, the class is there but no element of it. */
const Base = (globalThis.HTMLElement ?? Object) as new () => Listens & HTMLElement;
/** Pause before a file that was replaced is read anew, in milliseconds; it doubles with each time, up to the longest. */
const REPLACED_PAUSE = 1000;
const LONGEST_REPLACED_PAUSE = 60_000;
/** The stream is told the view once that has rested for so long, in milliseconds. */
const VIEW_REST = 150;

/** The script of what few ask for, fetched for the first of them. */
const extras = () => import('./extras.js');
/** What it is given. */
const KIT = { DirectionalLight, parseQuantity, parseView };

/**
 * `<lightwell-view src="room.lw.glb" camera-controls>` shows a pack.
 *
 * Attributes: `src`, `poster` (a picture until the first frame), `loading` ("auto" and "eager" at once, "lazy" when it comes
 * near the screen), `camera-controls` ("always": swipes and the wheel never scroll the page; "walk"), `camera-orbit` ("30deg 75deg 4m":
 * azimuth, angle from the vertical, distance), `camera-target` ("0m 1m 0m"), `field-of-view` ("45deg"), `exposure` (stops; by
 * default the pack's), `environment-background` ("sharp", "blurred", "none"), `light` ("all", "off", "direct", "indirect"), `shadows` ("soft", "hard", "off"), `tone` ("neutral", "none"), `strategy`
 * ("interleave", "geometry", "light"), `wireframe`, `auto-rotate`, `animation` (a name, or none for the first), `compare` (0 to 1), `measure`, `raking-light`, `any-three`, `max-image-megapixels`.
 *
 * Events: `load` when the scene is there, `firstframe`, `frame` after each, `progress` (detail: geometry, light, bytes, rate ...), `connection`
 * (detail.state: "streaming", "waiting", "complete"), `complete`, `camera-change`, `error` (detail: reason, message).
 *
 * Slots: "progress" and "error" take the places of the bar and of the message; "hotspot-NAME" stands at a point of the scene.
 *
 * Of many elements those near the screen draw, twelve at most, and six on a phone; another one shows its last picture, and loads anew
 * when it is wanted again. What the page has put into `scene` stays.
 */
export class LightwellView extends Base implements ContextHolder {
  static readonly observedAttributes = [...DRAWN_ATTRIBUTES, 'src', 'loading', 'poster'];

  /** The three.js scene, for objects of the page's own; call `invalidate` after a change. */
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera();
  #overlay: Overlay | null = null;
  /** While the element has a WebGL context. */
  #stage: Stage | null = null;
  #orbit: Orbit | null = null;
  #pack: LightwellScene | null = null;
  /** Of the pack that is loading or shown; null when none is. */
  #loader: LightwellLoader | null = null;
  #replacedPause = REPLACED_PAUSE;
  /** Of light groups. */
  readonly #factors = new Map<string, number | [number, number, number]>();
  #near = false;
  #paused = false;
  #complete = false;
  #firstFrame = false;
  #progress: Progress | null = null;
  #wantedView: View | null = null;
  /** Of the pack that was shown when the context was given back. */
  #keptView: View | null = null;
  #viewTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #resize = new ResizeObserver(() => this.#stage?.resize(this.clientWidth, this.clientHeight));
  readonly #intersection = new IntersectionObserver((entries) => this.#onIntersection(entries.at(-1)!.isIntersecting), {
    rootMargin: '100px',
  });

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

  /** Shows again what was to be seen at first. */
  reset(): void {
    this.#orbit?.reset();
  }

  /** The names of the pack's cameras, in the file's order. */
  get cameraNames(): string[] {
    return cameraNames(this.#pack);
  }

  /** Looks through the pack's camera of a name. Throws when it has none. */
  lookThrough(name: string): void {
    const camera = cameraNamed(this.#pack, name);
    this.#stage?.takeFieldOfView(camera);
    this.#orbit?.lookThrough(camera, this.#pack!);
  }

  /** Brings the camera to a view, a hotspot's or a file camera's: resolves when it is there, rejects when there is none of the name. */
  async goTo(place: View | string): Promise<void> {
    return (await extras()).goTo(this, place, KIT);
  }

  /** Dims, colours or switches a group of the pack's lamps with all of its light: LightwellScene.setLightGroup. Stays when `src` changes. */
  setLightGroup(name: string, factor: number | [number, number, number]): void {
    this.#pack?.setLightGroup(name, factor);
    this.#factors.set(name, factor);
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
    this.#stage.sharpen();
    this.#stage.draw();
    return this.#stage.canvas.toDataURL(type, quality);
  }

  connectedCallback(): void {
    if (this.#overlay === null) {
      const find = () => this.querySelector('[slot^=hotspot]') && extras().then(({ hotspots }) => hotspots(this, KIT));
      new MutationObserver(find).observe(this, { childList: true });
      void find();
      this.#overlay = new Overlay(this.attachShadow({ mode: 'open' }));
      for (const use of ['pointerenter', 'focusin']) this.addEventListener(use, () => this.#wake());
      this.#apply('poster');
    }
    this.#resize.observe(this);
    this.#intersection.observe(this);
    if (this.getAttribute('loading') !== 'lazy') wantContext(this);
  }

  disconnectedCallback(): void {
    this.#resize.disconnect();
    this.#intersection.disconnect();
    this.#near = false;
    dropContext(this);
  }

  get near(): boolean {
    return this.#near;
  }

  get spare(): boolean {
    return !this.#near || (this.#complete && !this.matches(':hover, :focus-within'));
  }

  takeContext(): void {
    try {
      this.#stage = new Stage(this.scene, this.camera);
    } catch (error) {
      // A turn later the page can listen.
      return void setTimeout(() => this.#onFailure('unsupported', messageOf(error)));
    }
    const stage = this.#stage;
    const focused = this.shadowRoot!.activeElement !== null;
    this.#orbit = new Orbit(this.camera, stage.canvas, () => this.#onView());
    stage.beforeFrame = (time) => this.#orbit!.update(time);
    stage.afterFrame = () => this.#onFrame();
    stage.canvas.addEventListener('dblclick', (event) => extras().then(({ focus }) => focus(this, event)));
    this.#overlay!.setCanvas(stage.canvas);
    stage.setRunning(this.#near);
    stage.resize(this.clientWidth, this.clientHeight);
    for (const name of DRAWN_ATTRIBUTES) this.#apply(name);
    if (focused) stage.canvas.focus({ preventScroll: true });
    this.#open();
  }

  /** The last picture stands for the scene, which is as it was when it comes back. */
  giveContextBack(): void {
    const stage = this.#stage;
    if (stage === null) return;
    if (this.#firstFrame) {
      stage.draw();
      this.#overlay!.keep(stage.canvas);
      this.#keptView = this.view;
    }
    clearTimeout(this.#viewTimer);
    this.#unload();
    this.#orbit!.dispose();
    stage.dispose();
    stage.canvas.remove();
    this.#stage = this.#orbit = null;
  }

  attributeChangedCallback(name: string): void {
    if (this.#overlay === null) return;
    if (name === 'src') this.#onSource();
    else if (name === 'loading') this.#wake();
    else if (name === 'poster' || this.#stage !== null) this.#apply(name);
  }

  /** Listens to one of the element's own events; gives its detail. */
  on<Name extends keyof LightwellViewDetails>(name: Name, listener: (detail: LightwellViewDetails[Name]) => void): void {
    this.addEventListener(name, (event) => event instanceof CustomEvent && listener(event.detail as LightwellViewDetails[Name]));
  }

  #onSource(): void {
    this.#keptView = null;
    if (this.#stage !== null) return this.#open();
    this.#apply('poster');
    this.#wake();
  }

  /** Sees to it that what is to be seen loads: it is near, or is not to wait for that. */
  #wake(): void {
    if (!this.isConnected || (this.getAttribute('loading') === 'lazy' && !this.#near)) return;
    if (this.#stage === null) wantContext(this);
    else if (this.#loader === null) this.#open();
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
    const lookup = parseWord(this.getAttribute('light-lookup'), LOOKUPS);
    const loader = (this.#loader = new LightwellLoader());
    const current = () => loader === this.#loader;
    this.#overlay!.setProgress({ done: 0, total: 0 });
    const onConnection = (state: ConnectionEvent['state']) => current() && this.#emit('connection', { state });
    const anyThree = this.hasAttribute('any-three');
    const maxImageMegapixels = Number(this.getAttribute('max-image-megapixels'));
    loader.setRenderer(stage.renderer).setOptions({ strategy, lookup, onConnection, anyThree, maxImageMegapixels }).load(
      src,
      (pack) => this.#show(pack),
      ({ loaded, total }) => current() && this.#overlay!.setProgress({ done: loaded, total }),
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
    this.#overlay!.say('');
    this.#stage?.invalidate();
  }

  #show(pack: LightwellScene): void {
    const stage = this.#stage!;
    this.#pack = pack;
    pack.addEventListener('change', () => stage.invalidateSeldom());
    pack.addEventListener('geometry', () => stage.invalidateShadows());
    pack.addEventListener('progress', ({ progress }) => {
      this.#progress = progress;
      this.#overlay!.setProgress(progress.bytes);
      this.#emit('progress', progress);
    });
    pack.addEventListener('connection', ({ state }) => this.#emit('connection', { state }));
    pack.addEventListener('failure', ({ reason, message }) => this.#onFailure(reason, message));
    pack.addEventListener('complete', () => stage.finish(() => pack === this.#pack && this.#onComplete()));
    stage.scene.add(pack);
    this.#pauseOrResume();
    for (const [name, factor] of this.#factors) if (pack.lightGroups.includes(name)) pack.setLightGroup(name, factor);
    for (const name of ['field-of-view', 'exposure', 'light', 'shadows', 'wireframe']) this.#apply(name);
    this.#frame(pack);
    stage.invalidateShadows();
    this.#emit('load', null);
  }

  /** A file that was replaced is another pack: what has come of the old one is of no use. */
  #onFailure(reason: LightwellViewDetails['error']['reason'], message: string): void {
    this.#emit('error', { reason, message });
    if (reason !== 'replaced') {
      console.error(`lightwell-view: ${message}`);
      return this.#overlay!.say(message);
    }
    const loader = this.#loader;
    if (this.#pack !== null) this.#keptView = this.view;
    setTimeout(() => loader === this.#loader && this.#load(), this.#replacedPause);
    this.#replacedPause = Math.min(2 * this.#replacedPause, LONGEST_REPLACED_PAUSE);
  }

  #frame(pack: LightwellScene): void {
    const camera = pack.opening.gltf.cameras[0];
    if (!this.hasAttribute('field-of-view')) this.#stage!.takeFieldOfView(camera);
    this.#orbit!.frame(pack, camera);
    this.#apply('camera-orbit');
    const view = this.#wantedView ?? this.#keptView;
    if (view !== null) this.#orbit!.view = view;
    this.#wantedView = this.#keptView = null;
  }

  #apply(name: string): void {
    const stage = this.#stage!;
    const value = this.getAttribute(name);
    switch (name) {
      case 'poster':
        return this.#firstFrame ? undefined : this.#overlay!.setPoster(value);
      case 'camera-controls':
        this.#orbit!.allow(value);
        return value === 'walk' ? this.#begin(name) : undefined;
      case 'camera-orbit':
      case 'camera-target':
        return this.#setCamera();
      case 'field-of-view':
        return value === null ? undefined : stage.setFieldOfView(((parseQuantity(value) ?? Math.PI / 4) * 180) / Math.PI);
      case 'exposure':
        return stage.setExposure(parseQuantity(value ?? '') ?? this.#pack?.exposure ?? 0);
      case 'environment-background':
      case 'light':
        return this.#setLight(parseWord(this.getAttribute('light'), LIGHTS));
      case 'shadows':
        return this.#pack?.setShadows(parseWord(value, SHADOWS));
      case 'tone':
        return stage.setTone(parseWord(value, TONES));
      case 'strategy':
        return this.#pack?.setStrategy(parseWord(value, STRATEGIES));
      case 'wireframe':
        return void this.#pack?.setWireframe(value !== null);
      case 'aria-label':
        stage.canvas.setAttribute('role', 'img');
        return stage.canvas.setAttribute('aria-label', value ?? DEFAULT_LABEL);
      case 'raking-light':
        this.#apply('light');
    }
    if (value !== null) this.#begin(name);
  }

  /** What an attribute says is done by the script of what few ask for. */
  #begin(name: string): void {
    void extras().then(({ attributes }) => attributes[name]!(this, KIT));
  }

  #setCamera(): void {
    if (this.#pack === null) return;
    const view = parseView(this.getAttribute('camera-orbit'), this.getAttribute('camera-target'), this.#orbit!.view);
    if (view === null) return;
    this.#orbit!.view = view;
    this.#orbit!.save();
  }

  #setLight(light: (typeof LIGHTS)[number]): void {
    const baked = light === 'all' || light === 'indirect';
    for (const grid of this.#pack?.grids ?? []) grid.visible = baked;
    this.#pack?.environment?.putAround(this.scene, this.getAttribute('environment-background'), baked);
    for (const lamp of this.#pack?.lamps ?? []) lamp.visible = (light === 'all' || light === 'direct') && !this.hasAttribute('raking-light');
    this.#stage!.invalidateShadows();
  }

  #onIntersection(near: boolean): void {
    this.#near = near;
    this.#stage?.setRunning(near);
    if (near) this.#wake();
    serveContexts();
    this.#pauseOrResume();
  }

  /** Asks for nothing that is not about to be seen. */
  #pauseOrResume(): void {
    this.#pack?.[this.#paused || !this.#near ? 'pause' : 'resume']();
  }

  #onFrame(): void {
    this.#emit('frame', null);
    if (this.#firstFrame || this.#pack === null) return;
    this.#firstFrame = true;
    this.#overlay!.hidePoster();
    this.#emit('firstframe', null);
  }

  #onComplete(): void {
    this.#complete = true;
    this.#overlay!.setProgress(null);
    this.#emit('complete', null);
    serveContexts();
  }

  #onView(): void {
    this.#stage?.invalidate();
    clearTimeout(this.#viewTimer);
    this.#viewTimer = setTimeout(() => this.#onRest(), VIEW_REST);
  }

  #onRest(): void {
    const stage = this.#stage!;
    // Its next frame may be long in coming.
    if (this.#near && this.#orbit!.moving) return this.#onView();
    stage.sharpen();
    if (this.#pack === null) return;
    this.#pack.setView(this.camera, stage.canvas.height);
    this.#emit('camera-change', this.#orbit!.view);
  }

  #emit<Name extends keyof LightwellViewDetails>(name: Name, detail: LightwellViewDetails[Name]): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}

// SPDX-License-Identifier: Apache-2.0
import type {
  Box3,
  BufferGeometry,
  Camera,
  Object3D,
  Points,
  PointsMaterial,
  Sphere,
  SpotLight,
  WebGLRenderer,
} from 'three';
import type { DirectKit } from '../direct_kit.js';
import type { LampDefinition } from '../extensions.js';
import type { FrameScheduler, FrameTask } from '../frame_scheduler.js';
import { aside } from './aside.js';
import { letLampsThrough } from './casters.js';
import { three, useKit } from './kit.js';
import { KnownShares } from './known_shares.js';
import { createLamp, formOf, type Lamp, type PlacedLamp, placed } from './lamp.js';
import { type LampPoint, middleOf, pointOf } from './lamp_points.js';
import { LampTable } from './lamp_table.js';
import { DECAY_OF_LAMPS, installLampChunks } from './lights_chunks.js';
import { begin, enoughPointsOf, FIRST_SHOWN, isSettled, Rounds, type Shadow, strengthOf } from './rounds.js';
import { middleMap, SampleMaps } from './sample_maps.js';
import { ScreenShares } from './screen_shares.js';
import type { ShadowMap } from './shadow_map.js';
import { ShadowSteps } from './shadow_steps.js';
import { SkyInGrids } from './sky_in_grids.js';
import { SkyLamp, type SkyOfPack } from './sky_lamp.js';
import { signatureOf, Surfaces } from './surfaces.js';
import { Turns } from './turns.js';

export type Shadows = 'soft' | 'hard' | 'off';

/** From so many points on the sky is shown as a lamp; until then the grid shows it. */
const POINTS_TO_SHOW_SKY = 64;
/** Of the GPU's time in a frame, milliseconds. */
const BUDGET = 4;
/** While geometry streams in, shadows are drawn anew at most so often, in milliseconds. */
const INTERVAL = 500;

export interface Surroundings extends SkyOfPack {
  readonly renderer: WebGLRenderer;
  readonly scheduler: FrameScheduler;
  /** Of all meshes, in the pack's space. */
  readonly bounds: Box3;
  /** Called when a better picture can be drawn. */
  readonly changed: () => void;
}

/**
 * The direct light of a pack's lamps. Before a picture's first object is drawn, whoever draws it, all pixels' shares of each lamp are
 * made ready; between pictures, while nothing changes, they are refined by shadow maps from ever more points of the lamps.
 */
export class DirectLight {
  readonly lamps: Lamp[];
  /** Stands for all lamps: three.js gives its map to every material that is lit. */
  readonly carrier: SpotLight;
  /** Is drawn first, and shows nothing. No mesh, so that who looks for the pack's meshes finds those alone. */
  readonly hook: Points<BufferGeometry, PointsMaterial>;
  readonly #surroundings: Surroundings;
  readonly #surfaces: Surfaces;
  readonly #shares: ScreenShares;
  readonly #table: LampTable;
  readonly #shadows: Shadow[];
  readonly #scratch = new SampleMaps();
  readonly #task: FrameTask;
  readonly #floats: boolean;
  readonly #sky: SkyLamp;
  readonly #skyInGrids: SkyInGrids;
  readonly #steps: ShadowSteps;
  readonly #known: KnownShares;
  readonly #rounds = new Rounds();
  /** Of the round whose shadows are being measured. */
  #measuring: symbol | null = null;
  #kind: Shadows = 'soft';
  #root: Object3D | null = null;
  /** Of the present view, whose surfaces are drawn when somebody asks for them. */
  #camera: Camera | null = null;
  #surfacesStale = true;
  #signature = NaN;
  #seenStale = true;
  #mapsTime = -Infinity;
  #growing: ReturnType<typeof setTimeout> | undefined;
  #showStale = true;
  readonly #turns = new Turns();
  #drawing = false;
  #resting = false;
  #paused = false;
  #batch = 1;

  constructor(kit: DirectKit, definitions: LampDefinition[], surroundings: Surroundings) {
    useKit(kit);
    installLampChunks();
    this.#surroundings = surroundings;
    const { renderer, scheduler } = surroundings;
    letLampsThrough(definitions, surroundings.opening, surroundings.focus);
    this.lamps = [...definitions, ...SkyLamp.of(surroundings)].map(createLamp);
    this.#floats = renderer.extensions.has('EXT_color_buffer_float');
    this.#surfaces = new Surfaces(renderer);
    this.#table = new LampTable(this.lamps.length);
    // Each colour of the sky, the last lamp, has a share of its own, and one that its grids have.
    const hasSky = this.lamps.some(isSky);
    this.#shares = new ScreenShares(this.lamps.length + (hasSky ? 2 : 0), hasSky, this.#table.width);
    this.#skyInGrids = new SkyInGrids();
    this.#steps = new ShadowSteps();
    this.#known = new KnownShares();
    this.#shadows = this.lamps.map((lamp, i) => {
      const middle = middleMap(lamp.definition, definitions.length);
      return { lamp, shares: isSky(lamp) ? [i, i + 1, i + 2] : [i], middle, middleStale: true, form: null, count: -1, shown: 0, off: Infinity, strength: 0 };
    });
    this.carrier = new three.SpotLight(undefined, 0, 0, 1, 0, DECAY_OF_LAMPS);
    this.carrier.map = this.#floats ? this.#shares.picture.texture : this.#table.texture;
    this.hook = new three.Points(new three.BufferGeometry(), new three.PointsMaterial({ colorWrite: false, depthWrite: false }));
    this.hook.raycast = () => {};
    this.hook.geometry.boundingSphere = new three.Sphere();
    this.hook.frustumCulled = false;
    this.hook.renderOrder = -Infinity;
    this.hook.onBeforeRender = (_, __, camera) => this.#prepare(camera);
    this.#sky = new SkyLamp(surroundings, this.hook);
    this.#task = scheduler.add(() => this.#refine(), BUDGET);
  }

  /** How many points of each lamp that shines are in the picture, at least; Infinity when there are as many as there will be. */
  get samples(): number {
    const open = this.#open();
    return open.length === 0 ? Infinity : Math.max(0, Math.min(...open.map(({ count }) => count)));
  }

  /**
   * By how many steps that are just not seen the shadows in the picture may be off, at most: 1 is not seen. Infinity while that is not known, and 0
   * where nothing is to be known.
   */
  get error(): number {
    return Math.max(0, ...this.#shining().map((shadow) => (this.#enough(shadow) > 0 ? shadow.off : 0)));
  }

  /** `milliseconds`: of the GPU's time in a frame that samples may take. */
  setShadows(kind: Shadows, milliseconds = BUDGET): void {
    this.#kind = kind;
    this.#task.milliseconds = milliseconds;
    this.restart();
  }

  /** Takes no sample until `resume`. */
  pause(): void {
    this.#paused = true;
    this.#task.cancel();
  }

  resume(): void {
    this.#paused = false;
    if (this.#root !== null && this.samples < Infinity) this.#task.request();
  }

  /** The pack's meshes have more faces: what is seen is seen anew with the next picture, what casts shadows after a while. */
  grow(): void {
    this.#seenStale = true;
    this.#growing ??= setTimeout(() => {
      this.finish();
    }, Math.max(0, this.#mapsTime + INTERVAL - performance.now()));
  }

  /** The meshes have all of their faces: what casts shadows is seen anew at once. */
  finish(): void {
    if (this.#growing === undefined) return;
    clearTimeout(this.#growing);
    this.#growing = undefined;
    this.#known.cap(FIRST_SHOWN);
    this.#renew();
  }

  /** Begins anew, after the GPU has lost all or the scene has changed. */
  restart(): void {
    this.#known.forgetAll();
    for (const shadow of this.#shadows) shadow.shown = 0;
    this.#renew();
  }

  #renew(): void {
    this.#seenStale = true;
    for (const shadow of this.#shadows) shadow.form = null;
    this.#surroundings.changed();
  }

  dispose(): void {
    clearTimeout(this.#growing);
    this.#task.dispose();
    for (const { middle } of this.#shadows) middle.dispose();
    const { geometry, material } = this.hook;
    for (const part of [this.#surfaces, this.#shares, this.#scratch, this.#steps, this.#known, this.#skyInGrids, this.#table, this.carrier, geometry, material]) part.dispose();
  }

  /** Those whose light is seen; the sky is a lamp only where it has soft shadows. */
  #shining(): Shadow[] {
    const shines = ({ visible, intensity, color }: Lamp) => visible && intensity * Math.max(color.r, color.g, color.b) > 0;
    const soft = this.#floats && this.#kind === 'soft';
    return this.#shadows.filter(({ lamp }) => shines(lamp) && (!isSky(lamp) || (soft && this.#sky.replacesSomething)));
  }

  #enough({ lamp }: Shadow): number {
    return this.#kind === 'soft' ? enoughPointsOf(lamp) : 0;
  }

  /** Those that shine, and may be seen to be off. */
  #open(): Shadow[] {
    return this.#shining().filter((shadow) => !this.#isSettled(shadow));
  }

  #isSettled(shadow: Shadow): boolean {
    return isSettled(shadow, this.#enough(shadow), this.#exposure);
  }

  get #exposure(): number {
    const { toneMapping, toneMappingExposure } = this.#surroundings.renderer;
    return toneMapping === three.NoToneMapping ? 1 : toneMappingExposure;
  }

  /** Everything that materials read, for a camera that is about to draw. */
  #prepare(camera: Camera): void {
    if (this.#drawing) return;
    const { renderer } = this.#surroundings;
    const shining = this.#shining();
    const shadowed = this.#floats && this.#kind !== 'off' && shining.length > 0 && !('isArrayCamera' in camera);
    if (this.#floats) {
      this.#drawing = true;
      aside(renderer, () => {
        const moved = shining.length > 0 && this.#shares.see(renderer, camera, () => this.#leave(shining));
        if (shadowed) this.#look(camera, shining, moved);
        const shown = shining.filter((shadow) => !isSky(shadow.lamp) || (shadowed && this.#showsSky(shadow)));
        this.#sky.replaceInGrids(shown.some(({ lamp }) => isSky(lamp)));
        this.#writeTable(camera, shown, shadowed);
        this.#shares.showTable(renderer, this.#table.texture);
      });
      this.#drawing = false;
    } else this.#writeTable(camera, shining, false);
  }

  /** Looks the kept maps up where the view, what is seen, or the map is another than before. */
  #look(camera: Camera, shining: Shadow[], moved: boolean): void {
    const { renderer } = this.#surroundings;
    const root = (this.#root = topOf(this.hook));
    const signature = signatureOf(root);
    if (signature !== this.#signature) {
      for (const shadow of this.#shadows) Object.assign(shadow, { form: null, shown: 0 });
      this.#known.forgetAll();
      this.#seenStale = true;
    }
    this.#signature = signature;
    this.#camera = camera;
    if (moved || this.#seenStale) {
      if (!moved) this.#leave(shining);
      for (const shadow of this.#shadows) begin(shadow, -1);
      this.#surfacesStale = true;
      this.#seenStale = false;
      this.#skyInGrids.forget();
      this.#steps.forget();
    }
    for (const shadow of shining) {
      const form = placed(shadow.lamp);
      const now = formOf(form);
      if (isSky(shadow.lamp)) {
        const isNew = this.#sky.renew();
        if (isNew) {
          this.#skyInGrids.forget();
          this.#known.forget(shadow.shares[0]);
        }
        if (shadow.form === null || isNew) this.#mapsTime = performance.now();
        if (shadow.form === null || isNew || shadow.count < 0) this.#begin(shadow, now, 0);
        if (!this.#isSettled(shadow)) this.#scratch.of(shadow.lamp.definition, renderer);
        continue;
      }
      const changed = shadow.form?.some((x, i) => x !== now[i]);
      if (changed === true) this.#known.forget(shadow.shares[0]);
      if (changed !== false) {
        shadow.middleStale = true;
        this.#begin(shadow, now, -1);
      }
      if (!this.#isSettled(shadow)) this.#scratch.of(shadow.lamp.definition, renderer);
      if (shadow.count >= 0) continue;
      if (shadow.middleStale) {
        this.#drawMap(shadow.middle, form, middleOf(form));
        this.#mapsTime = performance.now();
        shadow.middleStale = false;
      }
      this.#drawSurfaces();
      this.#shares.add(renderer, shadow.shares[0], shadow.middle, 0, true);
      this.#begin(shadow, now, 0);
      this.#showStale = true;
    }
    if (shining.some((shadow) => isSky(shadow.lamp) && this.#showsSky(shadow)) && this.#drawSkyInGrids(camera)) this.#showStale = true;
    if (this.#showStale) this.#show();
    this.#showStale = false;
    if (this.samples === Infinity) this.#rest();
    if (this.#turns.take(camera, moved)) this.#task.cancel();
    else if (!this.#paused && this.samples < Infinity) this.#task.request();
  }

  /** Keeps what the picture shows of a view that is about to be left, unless a view before that knew more. */
  #leave(shining: Shadow[]): void {
    if (!this.#floats || this.#kind !== 'soft' || !shining.every(({ shown, form }) => shown > 0 && form !== null)) return;
    const points: number[] = [];
    for (const shadow of shining) for (const share of shadow.shares) points[share] = shadow.shown;
    this.#known.keep(this.#surroundings.renderer, this.#shares, points);
  }

  /** Shows all shares as they are now; what is known of a shadow beside its own samples counts the less, the more of all those it has. */
  #show(): void {
    const weights: number[] = [];
    let readyForSums = false;
    for (const shadow of this.#shining()) {
      const own = Math.max(0, isSky(shadow.lamp) && isYoung(shadow) ? 0 : shadow.count);
      if (isSky(shadow.lamp)) readyForSums = own === 0;
      const left = this.#isSettled(shadow) ? 0 : 1 - own / this.#enough(shadow);
      const known = left * this.#known.pointsOf(shadow.shares[0]);
      for (const share of shadow.shares) weights[share] = known > 0 ? known / (own + known) : 0;
      shadow.shown = own < FIRST_SHOWN ? 0 : own + known;
    }
    this.#shares.show(this.#surroundings.renderer, this.#known, weights, readyForSums);
  }

  /** Whether the sky is shown as a lamp. */
  #showsSky(shadow: Shadow): boolean {
    return !isYoung(shadow) || this.#known.pointsOf(shadow.shares[0]) > 0;
  }

  #begin(shadow: Shadow, form: number[], count: number): void {
    shadow.form = form;
    begin(shadow, count);
    this.#rounds.forget();
    this.#measuring = null;
  }

  /** Says whether it was not there. */
  #drawSkyInGrids(camera: Camera): boolean {
    if (this.#skyInGrids.has(this.#sky.replaced)) return false;
    this.#drawSurfaces();
    // The lamp's own colour may be another (LightGroups).
    const factors = this.lamps.find(isSky)!.userData.inGrids;
    const irradiance = this.#sky.irradiance(camera.matrixWorldInverse, factors);
    this.#skyInGrids.draw(this.#surroundings.renderer, this.#shares, camera, this.#sky.replaced, irradiance);
    return true;
  }

  /** With all samples nothing but the picture is needed any more: the memory of all else is given back. */
  #rest(): void {
    // Without samples the next view is soon another.
    if (this.#resting || this.#kind !== 'soft') return;
    this.#resting = this.#surfacesStale = true;
    this.#shares.rest();
    this.#scratch.dispose();
    this.#known.forgetAll();
    for (const shadow of this.#shadows) {
      shadow.middle.dispose();
      shadow.middleStale = true;
      if (!this.#isSettled(shadow)) begin(shadow, -1);
    }
  }

  /** Something has changed, and not all: lamps that have their samples keep their shares. */
  #wake(): void {
    this.#resting = false;
    this.#rounds.forget();
    // Of the sums the ratios are left: whose samples go on begins anew, and is shown as it was until then.
    for (const shadow of this.#open()) begin(shadow, Math.min(shadow.count, 0));
    const kept = this.#shadows.filter(({ count }) => count >= 0).flatMap(({ shares }) => shares);
    this.#shares.recall(this.#surroundings.renderer, kept);
  }

  /** What the present view shows, unless that is drawn. */
  #drawSurfaces(): void {
    if (this.#resting) this.#wake();
    if (this.#surfacesStale) this.#shares.drawSurfaces(this.#surfaces, this.#root!, this.#camera!);
    this.#surfacesStale = false;
  }

  #drawMap(map: ShadowMap, form: PlacedLamp, point: LampPoint): void {
    const { bounds, focus } = this.#surroundings;
    map.draw(this.#surfaces, this.#root!, form, point, this.#sphere(bounds), this.#sphere(focus));
  }

  #sphere(box: Box3): Sphere {
    return box.getBoundingSphere(new three.Sphere()).applyMatrix4(this.hook.matrixWorld);
  }

  #writeTable(camera: Camera, shown: Shadow[], shadowed: boolean): void {
    const lamps = shown.map((shadow): [Lamp, number] => [shadow.lamp, shadow.shares[0]]);
    this.#table.write(camera, lamps, shadowed, this.#shares, this.#sky.texels(camera.matrixWorldInverse));
  }

  /** Adds samples of the lamps of the present round. */
  #refine(): void {
    const { renderer, scheduler } = this.#surroundings;
    if (this.#paused || this.#growing !== undefined || this.#measuring !== null || this.#shining().some(({ count }) => count < 0)) return;
    if (this.#rounds.next() === undefined) this.#rounds.begin(this.#open(), (shadow) => this.#enough(shadow));
    if (this.#rounds.next() === undefined) return;
    const started = performance.now();
    const batch = this.#batch;
    aside(renderer, () => {
      for (let i = 0, next = this.#rounds.next(); i < batch && next !== undefined; i++, next = this.#rounds.next()) this.#sample(next);
    });
    scheduler.whenDone(() => (this.#batch = performance.now() - started < 20 ? Math.min(8, batch + 1) : Math.max(1, batch >> 1)));
    if (this.#rounds.next() === undefined) this.#endRound();
    else this.#task.request();
  }

  /** Measures how far off the lamps of a round are, and shows them. */
  #endRound(): void {
    const { renderer, changed } = this.#surroundings;
    const round = this.#rounds.lamps;
    const measuring = (this.#measuring = Symbol());
    const exposure = this.#exposure;
    aside(renderer, () => {
      this.#drawSurfaces();
      this.#steps.see(this.#surfaces, this.#root!, this.#camera!, this.#shares);
      const found = round.map((shadow) => this.#measure(shadow, exposure));
      this.#show();
      void Promise.all(found).then(
        (offs) => this.#measuring === measuring && this.#note(round, offs, exposure),
        () => {
          // The context is lost: all begins anew.
          if (this.#measuring === measuring) this.#measuring = null;
        },
      );
    });
    if (!isStill()) changed();
  }

  async #measure(shadow: Shadow, exposure: number): Promise<number> {
    // Before the sky is shown its light is that of the grids.
    if (isSky(shadow.lamp) && shadow.count < 2 * POINTS_TO_SHOW_SKY) return Infinity;
    return this.#steps.measure(this.#surroundings.renderer, this.#shares, shadow.shares[0], shadow.shares.length, exposure);
  }

  #note(round: Shadow[], offs: number[], exposure: number): void {
    this.#measuring = null;
    round.forEach((shadow, i) => Object.assign(shadow, { off: offs[i], strength: strengthOf(shadow, exposure) }));
    // What is good enough without is shown without what was known.
    this.#showStale ||= round.some((shadow) => this.#isSettled(shadow) && this.#known.pointsOf(shadow.shares[0]) > 0);
    if (this.samples < Infinity) this.#task.request();
    else this.#surroundings.changed();
  }

  #sample(shadow: Shadow): void {
    const { renderer } = this.#surroundings;
    const map = this.#scratch.of(shadow.lamp.definition, renderer);
    const form = placed(shadow.lamp);
    this.#drawSurfaces();
    this.#drawMap(map, form, isSky(shadow.lamp) ? this.#sky.pointOf(shadow.count) : pointOf(form, shadow.count));
    const { color = [1] } = map.point;
    color.forEach((strength, channel) => this.#shares.add(renderer, shadow.shares[channel]!, map, shadow.count, false, strength));
    shadow.count++;
  }
}

const isSky = ({ definition }: Lamp) => definition.kind === 'sky';

/** Of the sky: whether its own samples are too few to be shown. */
const isYoung = ({ count }: Shadow) => count < POINTS_TO_SHOW_SKY;

/** Whether a visitor wants nothing to change by itself: then the picture is shown when it is at rest. */
const isStill = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

function topOf(object: Object3D): Object3D {
  let top = object;
  while (top.parent !== null) top = top.parent;
  return top;
}

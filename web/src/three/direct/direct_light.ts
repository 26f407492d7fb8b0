// SPDX-License-Identifier: Apache-2.0
import type {
  Box3,
  BufferGeometry,
  Camera,
  DataTexture,
  Object3D,
  Points,
  PointsMaterial,
  Sphere,
  SpotLight,
  Vector3,
  WebGLRenderer,
} from 'three';
import type { DirectKit } from '../direct_kit.js';
import type { LampDefinition } from '../extensions.js';
import type { FrameScheduler, FrameTask } from '../frame_scheduler.js';
import { aside } from './aside.js';
import { letLampsThrough } from './casters.js';
import { three, useKit } from './kit.js';
import { createLamp, formOf, type Lamp, type PlacedLamp, placed, TEXELS_OF_LAMP, TEXELS_OF_SKY, texelsOf } from './lamp.js';
import { type LampPoint, middleOf, pointOf } from './lamp_points.js';
import { DECAY_OF_LAMPS, installLampChunks } from './lights_chunks.js';
import { ScreenShares } from './screen_shares.js';
import { ShadowMap } from './shadow_map.js';
import { SkyInGrids } from './sky_in_grids.js';
import { SkyLamp, type SkyOfPack } from './sky_lamp.js';
import { signatureOf, Surfaces } from './surfaces.js';

export type Shadows = 'soft' | 'hard' | 'off';

/** How many points of a lamp are enough: of one with an area, and of one without, whose map alone is smoothed. */
const POINTS = 256;
const POINTS_OF_POINT = 32;
/** Of the sky: under a uniform one half of its directions come from below a floor. */
const POINTS_OF_SKY = 512;
/** From so many points on the sky is shown as a lamp; until then the grid shows it. */
const POINTS_TO_SHOW_SKY = 64;
/** A visitor who saves data saves power, too. */
const SAVING = 4;
/** A picture is shown when every lamp has had so many points, and each time that they have doubled. */
const FIRST_SHOWN = 16;
/** Of the GPU's time in a frame, milliseconds. */
const BUDGET = 4;
/** Sides of the maps, in texels: of a cube's faces, and of a sun's picture. */
const CUBE_SIZE = 512;
const SUN_SIZE = 2048;
/** Of the sky's pictures, whose edges none of so many shows. */
const SKY_SIZE = 1024;
/** Of more lamps than this the maps that are kept are half as fine. */
const FEW_LAMPS = 4;
/** While geometry streams in, shadows are drawn anew at most so often, in milliseconds. */
const INTERVAL = 500;

/** A lamp's shadow in the present view. */
interface Shadow {
  readonly lamp: Lamp;
  /** From the lamp's middle; kept while nothing moves but the camera. */
  readonly middle: ShadowMap;
  form: number[] | null;
  /** Points whose samples are in the sums: 0 when only the middle is, -1 when nothing is. */
  count: number;
}

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
  readonly #table: DataTexture;
  readonly #shadows: Shadow[];
  readonly #scratch = new Map<number, ShadowMap>();
  readonly #task: FrameTask;
  readonly #floats: boolean;
  readonly #sky: SkyLamp;
  readonly #skyInGrids: SkyInGrids;
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
  /** The two views before, to tell cameras that take turns. */
  #views: string[] = [];
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
    const width = 2 + TEXELS_OF_LAMP * this.lamps.length + TEXELS_OF_SKY;
    this.#table = new three.DataTexture(new Float32Array(4 * width), width, 1, undefined, three.FloatType);
    // Each colour of the sky, the last lamp, has a share of its own, and one that its grids have.
    const hasSky = this.lamps.some(isSky);
    this.#shares = new ScreenShares(this.lamps.length + (hasSky ? 2 : 0), hasSky, width);
    this.#skyInGrids = new SkyInGrids();
    const size = definitions.length > FEW_LAMPS ? 2 : 1;
    this.#shadows = this.lamps.map((lamp) => {
      const middle = new ShadowMap(hasPicture(lamp), sizeOf(lamp) / size);
      return { lamp, middle, form: null, count: -1 };
    });
    this.carrier = new three.SpotLight(undefined, 0, 0, 1, 0, DECAY_OF_LAMPS);
    this.carrier.map = this.#floats ? this.#shares.picture.texture : this.#table;
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
    const open = this.#shining().filter((shadow) => shadow.count < this.#enough(shadow));
    return open.length === 0 ? Infinity : Math.max(0, Math.min(...open.map(({ count }) => count)));
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
      this.#growing = undefined;
      this.restart();
    }, Math.max(0, this.#mapsTime + INTERVAL - performance.now()));
  }

  /** The meshes have all of their faces: what casts shadows is seen anew at once. */
  finish(): void {
    if (this.#growing === undefined) return;
    clearTimeout(this.#growing);
    this.#growing = undefined;
    this.restart();
  }

  /** Begins anew, after the GPU has lost all or the scene has changed. */
  restart(): void {
    this.#seenStale = true;
    for (const shadow of this.#shadows) shadow.form = null;
    this.#surroundings.changed();
  }

  dispose(): void {
    clearTimeout(this.#growing);
    this.#task.dispose();
    for (const { middle } of this.#shadows) middle.dispose();
    for (const map of this.#scratch.values()) map.dispose();
    const { geometry, material } = this.hook;
    for (const part of [this.#surfaces, this.#shares, this.#skyInGrids, this.#table, this.carrier, geometry, material]) part.dispose();
  }

  /** Those whose light is seen; the sky is a lamp only where it has soft shadows. */
  #shining(): Shadow[] {
    const shines = ({ visible, intensity, color }: Lamp) => visible && intensity * Math.max(color.r, color.g, color.b) > 0;
    const soft = this.#floats && this.#kind === 'soft';
    return this.#shadows.filter(({ lamp }) => shines(lamp) && (!isSky(lamp) || (soft && this.#sky.replacesSomething)));
  }

  #enough({ lamp: { definition } }: Shadow): number {
    if (this.#kind !== 'soft') return 0;
    const saving = (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;
    const area = definition.kind === 'rectangle' || definition.kind === 'sphere';
    const points = definition.kind === 'sky' ? POINTS_OF_SKY : area ? POINTS : POINTS_OF_POINT;
    return points / (saving ? SAVING : 1);
  }

  /** Everything that materials read, for a camera that is about to draw. */
  #prepare(camera: Camera): void {
    if (this.#drawing) return;
    const { renderer } = this.#surroundings;
    const shining = this.#shining();
    const shadowed = this.#floats && this.#kind !== 'off' && shining.length > 0 && !('isArrayCamera' in camera);
    if (this.#floats) {
      const viewport = shining.length > 0 && this.#shares.see(renderer, camera);
      this.#drawing = true;
      aside(renderer, () => {
        if (shadowed) this.#look(camera, shining, viewport);
        const shown = shining.filter((shadow) => !isSky(shadow.lamp) || (shadowed && showsSky(shadow)));
        this.#sky.replaceInGrids(shown.some(({ lamp }) => isSky(lamp)));
        this.#writeTable(camera, shown, shadowed);
        this.#shares.showTable(renderer, this.#table);
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
      for (const shadow of this.#shadows) shadow.form = null;
      this.#seenStale = true;
    }
    this.#signature = signature;
    this.#camera = camera;
    if (moved || this.#seenStale) {
      for (const shadow of this.#shadows) shadow.count = -1;
      this.#surfacesStale = true;
      this.#seenStale = false;
      this.#skyInGrids.forget();
    }
    for (const shadow of shining) {
      const form = placed(shadow.lamp);
      const now = formOf(form);
      if (isSky(shadow.lamp)) {
        const isNew = this.#sky.renew();
        if (isNew) this.#skyInGrids.forget();
        if (shadow.form === null || isNew) this.#mapsTime = performance.now();
        if (shadow.form === null || isNew || shadow.count < 0) Object.assign(shadow, { form: now, count: 0 });
        if (shadow.count < this.#enough(shadow)) this.#scratchMap(shadow.lamp);
        continue;
      }
      if (shadow.form === null || now.some((x, i) => x !== shadow.form![i])) {
        this.#drawMap(shadow.middle, form, middleOf(form));
        this.#mapsTime = performance.now();
        Object.assign(shadow, { form: now, count: -1 });
      }
      if (shadow.count < this.#enough(shadow)) this.#scratchMap(shadow.lamp);
      if (shadow.count >= 0) continue;
      this.#drawSurfaces();
      this.#shares.add(renderer, this.#shadows.indexOf(shadow), shadow.middle, true, true);
      shadow.count = 0;
      this.#showStale = true;
    }
    if (shining.some((shadow) => isSky(shadow.lamp) && showsSky(shadow)) && this.#drawSkyInGrids(camera)) this.#showStale = true;
    if (this.#showStale) this.#shares.show(renderer);
    this.#showStale = false;
    if (this.samples === Infinity) this.#rest();
    if (this.#takesTurns(camera, moved)) this.#task.cancel();
    else if (!this.#paused && this.samples < Infinity) this.#task.request();
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

  /** With all samples nothing but the picture and the kept maps is needed any more: the memory of all else is given back. */
  #rest(): void {
    // Without samples the next view is soon another.
    if (this.#resting || this.#kind !== 'soft') return;
    this.#resting = this.#surfacesStale = true;
    this.#shares.rest();
    for (const map of this.#scratch.values()) map.dispose();
    this.#scratch.clear();
    for (const shadow of this.#shadows) if (shadow.count < this.#enough(shadow)) shadow.count = -1;
  }

  /** Something has changed, and not all: lamps that have their samples keep their shares. */
  #wake(): void {
    this.#resting = false;
    const kept = this.#shadows.flatMap(({ lamp, count }, share) => (count < 0 ? [] : isSky(lamp) ? [share, share + 1, share + 2] : [share]));
    this.#shares.recall(this.#surroundings.renderer, kept);
  }

  /** What the present view shows, unless that is drawn. */
  #drawSurfaces(): void {
    if (this.#resting) this.#wake();
    if (this.#surfacesStale) this.#shares.drawSurfaces(this.#surfaces, this.#root!, this.#camera!);
    this.#surfacesStale = false;
  }

  /** Whether two cameras draw one after the other, for ever: a picture that a refinement asked for would undo it. */
  #takesTurns(camera: Camera, moved: boolean): boolean {
    const view = camera.uuid;
    const turns = moved && this.#views[0] !== undefined && this.#views[1] === view && this.#views[0] !== view;
    if (moved) this.#views = [view, this.#views[0] ?? view];
    else this.#views = [view];
    return turns;
  }

  #drawMap(map: ShadowMap, form: PlacedLamp, point: LampPoint): void {
    const { bounds, focus } = this.#surroundings;
    map.draw(this.#surfaces, this.#root!, form, point, this.#sphere(bounds), this.#sphere(focus));
  }

  #sphere(box: Box3): Sphere {
    return box.getBoundingSphere(new three.Sphere()).applyMatrix4(this.hook.matrixWorld);
  }

  #writeTable(camera: Camera, shining: Shadow[], shadowed: boolean): void {
    const view = camera.matrixWorldInverse;
    const space = {
      point: (of: Vector3) => of.clone().applyMatrix4(view),
      direction: (of: Vector3) => of.clone().applyMatrix4(view).sub(new three.Vector3().setFromMatrixPosition(view)),
    };
    const texels = shining.flatMap((shadow) => texelsOf(placed(shadow.lamp), space, this.#shadows.indexOf(shadow)));
    const data = this.#table.image.data as Float32Array;
    const { width, height, viewport } = this.#shares;
    const now = new Float32Array(data.length);
    now.set([shining.length, Number(shadowed), width, height, ...viewport.toArray(), ...this.#sky.texels(view), ...texels]);
    if (now.every((number, i) => number === data[i])) return;
    data.set(now);
    this.#table.needsUpdate = true;
  }

  /** Adds samples of the lamps that have fewest. */
  #refine(): void {
    const { renderer, scheduler, changed } = this.#surroundings;
    const countOf = (shadow: Shadow) => (shadow.count < this.#enough(shadow) ? shadow.count : Infinity);
    const least = () => Math.min(...this.#shining().map(countOf));
    if (this.#paused || this.#growing !== undefined || this.#shining().some(({ count }) => count < 0)) return;
    const before = least();
    const started = performance.now();
    const batch = this.#batch;
    const isShown = (count: number) => count === Infinity || (count >= FIRST_SHOWN && isPowerPassed(before, count));
    aside(renderer, () => {
      // No point more than a picture's: the sequence is evenest at powers of two.
      for (let i = 0; i < batch && !isShown(least()); i++) this.#sample(this.#shining().find(({ count }) => count === least())!);
    });
    scheduler.whenDone(() => (this.#batch = performance.now() - started < 20 ? Math.min(8, batch + 1) : Math.max(1, batch >> 1)));
    const after = least();
    if (isShown(after)) {
      this.#showStale = true;
      changed();
    }
    if (after < Infinity) this.#task.request();
  }

  /** What samples are drawn into, one after another. */
  #scratchMap(lamp: Lamp): ShadowMap {
    const size = sizeOf(lamp);
    let map = this.#scratch.get(size);
    if (map === undefined) {
      map = new ShadowMap(hasPicture(lamp), size);
      map.allocate(this.#surroundings.renderer);
      this.#scratch.set(size, map);
    }
    return map;
  }

  #sample(shadow: Shadow): void {
    const { renderer } = this.#surroundings;
    const map = this.#scratchMap(shadow.lamp);
    const form = placed(shadow.lamp);
    this.#drawSurfaces();
    this.#drawMap(map, form, isSky(shadow.lamp) ? this.#sky.pointOf(shadow.count) : pointOf(form, shadow.count));
    const share = this.#shadows.indexOf(shadow);
    const { color = [1] } = map.point;
    color.forEach((strength, channel) => this.#shares.add(renderer, share + channel, map, shadow.count === 0, false, strength));
    shadow.count++;
  }
}

const isSky = ({ definition }: Lamp) => definition.kind === 'sky';

/** Whether the sky is shown as a lamp. */
const showsSky = ({ count }: Shadow) => count >= POINTS_TO_SHOW_SKY;

/** Whether its light comes from far away: its shadow is one picture, not a cube. */
const hasPicture = ({ definition }: Lamp) => definition.kind === 'sun' || definition.kind === 'sky';

/** The side of its maps, in texels; no two kinds of maps have the same. */
function sizeOf({ definition }: Lamp): number {
  return definition.kind === 'sun' ? SUN_SIZE : definition.kind === 'sky' ? SKY_SIZE : CUBE_SIZE;
}

/** Whether a power of two lies between two numbers, the latter included. */
function isPowerPassed(before: number, after: number): boolean {
  return Math.floor(Math.log2(after)) > Math.floor(Math.log2(Math.max(before, 0.5)));
}

function topOf(object: Object3D): Object3D {
  let top = object;
  while (top.parent !== null) top = top.parent;
  return top;
}

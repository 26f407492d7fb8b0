// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, Camera, Matrix4, Object3D, Texture, Vector4, WebGLRenderer, WebGLRenderTarget } from 'three';
import seenSurface from '../../../../shaders/seen_surface.glsl';
import keptShader from '../../../../shaders/kept_share.glsl';
import lookupShader from '../../../../shaders/shadow_lookup.glsl';
import sharesShader from '../../../../shaders/shadow_shares.glsl';
import { COPY, createScreen, FullScreen } from './full_screen.js';
import { three } from './kit.js';
import type { KnownShares } from './known_shares.js';
import { textForPasses } from './lights_chunks.js';
import type { ShadowMap } from './shadow_map.js';
import type { Surfaces } from './surfaces.js';

const SUMS = 6;
/** That the sums may take, in bytes: of many lamps in a large picture they are coarser than its pixels. */
const MOST_BYTES = 96 * 2 ** 20;
const BYTES_OF_A_SUM = 8;
/** And of what is ready without sums. */
const READY = 3;
/** From sample to sample another place of the pixel is looked up, all over it (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018). */
const WITHIN_PIXEL = [0.7548776662466927, 0.5698402909980532];
/** Of steep planes (shaders/shadow_lookup.glsl): of a sky, many of whose directions are all but along any plane, less. */
const [MOST_RISE, MOST_RISE_OF_SKY] = [0.01, 0.00125];
/** Controls find a camera that rests anew for every picture, each time with other roundings. */
const ROUNDING = 1e-9;

/**
 * For every pixel of a view, or every few of them, which share of each lamp reaches it: the ratio of two sums over points of the lamp,
 * which are kept apart for each lamp. `picture` is what materials read (shaders/direct_light.glsl).
 */
export class ScreenShares {
  readonly picture: WebGLRenderTarget;
  /** Three shares as colours, for who knows them otherwise than by samples. */
  readonly ready: WebGLRenderTarget;
  readonly #surfaces: WebGLRenderTarget;
  readonly #sums: WebGLRenderTarget[];
  /** The sums are added up from one target into another, which then takes its place. */
  #spare: WebGLRenderTarget;
  readonly #screen: BufferGeometry = createScreen();
  readonly #lookups = new Map<string, FullScreen>();
  readonly #shares: FullScreen;
  readonly #table: FullScreen;
  readonly #kept: FullScreen;
  readonly #viewport: Vector4 = new three.Vector4();
  readonly #place: Matrix4 = new three.Matrix4();
  readonly #projection: Matrix4 = new three.Matrix4();
  readonly #view: Matrix4 = new three.Matrix4();

  /** `sums`: how many shares are the ratios of sums; behind those there may be three that are `ready` without. */
  constructor(
    sums: number,
    private readonly hasReady: boolean,
    private readonly tableWidth: number,
  ) {
    const floats = { type: three.FloatType, minFilter: three.NearestFilter, magFilter: three.NearestFilter };
    const flat = { ...floats, depthBuffer: false };
    const sum = () => new three.WebGLRenderTarget(1, 1, { ...flat, format: three.RGFormat });
    this.picture = new three.WebGLRenderTarget(tableWidth, 2, flat);
    this.picture.scissorTest = true;
    this.#surfaces = new three.WebGLRenderTarget(1, 1, floats);
    this.#sums = Array.from({ length: sums }, sum);
    this.ready = new three.WebGLRenderTarget(1, 1, { ...flat, type: three.HalfFloatType });
    this.#spare = sum();
    const textures = Array.from({ length: SUMS }, () => null);
    const names = ['surfaces', 'projection', 'ready', 'firstReady', 'readyForSums', 'start', 'firstShare', 'known', 'toKnown', 'knownProjection'];
    this.#shares = new FullScreen(this.#screen, [seenSurface, sharesShader].join('\n'), {
      ...Object.fromEntries(names.map((name) => [name, { value: null }])),
      sums: { value: textures },
      knownWeights: { value: [] },
    });
    this.#table = new FullScreen(this.#screen, COPY, { copied: { value: null } });
    this.#kept = new FullScreen(this.#screen, `${textForPasses()}\n${keptShader}`, { picture: { value: null }, share: { value: 0 } });
  }

  /** In pixels of the picture, and how many there are of them, or fewer, in shares. */
  get viewport(): Vector4 {
    return this.#viewport;
  }

  get width(): number {
    return this.#surfaces.width;
  }

  get height(): number {
    return this.#surfaces.height;
  }

  /** From the world into the camera's space, and from there into the picture. */
  get view(): Matrix4 {
    return this.#view;
  }

  get projection(): Matrix4 {
    return this.#projection;
  }

  /**
   * Takes the view of a camera into the renderer's present viewport; says whether it is another than before. `leave`: called before that one's
   * picture is lost.
   */
  see(renderer: WebGLRenderer, camera: Camera, leave: () => void): boolean {
    const viewport = renderer.getCurrentViewport(new three.Vector4());
    const sameCamera = isSame(camera.matrixWorld, this.#place) && isSame(camera.projectionMatrix, this.#projection);
    if (sameCamera && viewport.equals(this.#viewport)) return false;
    leave();
    this.#viewport.copy(viewport);
    this.#place.copy(camera.matrixWorld);
    this.#view.copy(camera.matrixWorldInverse);
    this.#projection.copy(camera.projectionMatrix);
    const targets = this.#sums.length + 1 + Number(this.hasReady);
    const sharpness = Math.min(1, Math.sqrt(MOST_BYTES / (BYTES_OF_A_SUM * targets * viewport.z * viewport.w)));
    const [width, height] = [viewport.z, viewport.w].map((pixels) => Math.max(1, Math.floor(pixels * sharpness))) as [number, number];
    for (const target of [this.#surfaces, this.#spare, ...this.#sums, ...(this.hasReady ? [this.ready] : [])]) {
      target.setSize(width, height);
      // Their memory is taken now, so that no later frame waits for that.
      renderer.initRenderTarget(target);
    }
    this.picture.setSize(Math.max(this.tableWidth, this.#layers * width), height + 1);
    return true;
  }

  /** Gives the memory back that only more samples need, until `recall`. */
  rest(): void {
    for (const target of [this.#surfaces, this.#spare, ...this.#sums]) target.dispose();
  }

  /** Takes the memory again; the sums of some shares are made from the picture, those of others are to begin anew, and so is what is seen. */
  recall(renderer: WebGLRenderer, shares: number[]): void {
    for (const target of [this.#surfaces, this.#spare, ...this.#sums]) renderer.initRenderTarget(target);
    for (const share of shares) this.#kept.draw(renderer, this.#sums[share]!, { picture: this.picture.texture, share });
  }

  /** Draws what is seen anew. */
  drawSurfaces(surfaces: Surfaces, root: Object3D, camera: Camera): void {
    surfaces.renderer.setRenderTarget(this.#surfaces);
    surfaces.draw(root, 'seen', (render) => render(camera));
  }

  /**
   * Looks a map up for every pixel: adds the sample of a number from 0 on, of some strength, to the sums of a share, which begin with the first. `soft`: filtered,
   * as a lamp's only sample.
   */
  add(renderer: WebGLRenderer, share: number, map: ShadowMap, index: number, soft: boolean, strength = 1): void {
    const { point, range, sun } = map;
    const axes = new three.Matrix3();
    const [x, y, z] = point.axes.map((axis) => axis.clone().transformDirection(this.#view));
    axes.set(x!.x, x!.y, x!.z, y!.x, y!.y, y!.z, z!.x, z!.y, z!.z);
    this.#lookup(sun, soft).draw(renderer, this.#spare, {
      surfaces: this.#surfaces.texture,
      sums: this.#sums[share]!.texture,
      depths: map.depths,
      first: index === 0,
      within: soft ? new three.Vector2() : new three.Vector2(...WITHIN_PIXEL.map((step) => ((0.5 + index * step) % 1) - 0.5)),
      strength,
      projection: this.#projection,
      axes,
      point: (sun ? map.center : point.position).clone().applyMatrix4(this.#view),
      normal: soft ? new three.Vector3() : point.normal.clone().transformDirection(this.#view),
      bothSides: point.bothSides,
      size: map.size,
      range: new three.Vector2(...range),
      mostRise: point.color ? MOST_RISE_OF_SKY : MOST_RISE,
    });
    [this.#sums[share], this.#spare] = [this.#spare, this.#sums[share]!];
  }

  /** The sums of each colour: of a share, or, where there are two more behind it, of three. */
  sumsOf(share: number, colours = 1): Texture[] {
    return [0, 1, 2].map((channel) => this.#sums[share + (colours > 1 ? channel : 0)]!.texture);
  }

  /** What a pass reads that comes behind shaders/seen_surface.glsl. */
  get seen(): Record<string, unknown> {
    return { surfaces: this.#surfaces.texture, projection: this.#projection };
  }

  /**
   * Shows the shares as they are now, and, where the view before saw a place, mixed with what that one knew: of each share by a weight from 0 to 1.
   * `readyForSums`: the last three sums are not yet to be shown, but what is the same without sums.
   */
  show(renderer: WebGLRenderer, known: KnownShares, weights: number[], readyForSums: boolean): void {
    const { width, height } = this;
    for (let layer = 0; layer < this.#layers; layer++) {
      const sums = Array.from({ length: SUMS }, (_, i): Texture => (this.#sums[layer * SUMS + i] ?? this.#spare).texture);
      this.#part(layer * width, 1, width, height);
      const firstReady = this.hasReady ? this.#sums.length - layer * SUMS : SUMS;
      const start = new three.Vector2(layer * width, 1);
      const firstShare = layer * SUMS;
      const knownWeights = Array.from({ length: SUMS }, (_, i) => weights[firstShare + i] ?? 0);
      const ready = { ready: this.ready.texture, firstReady, readyForSums };
      this.#shares.draw(renderer, this.picture, { ...this.seen, ...known.from(this.#view), ...ready, sums, start, firstShare, knownWeights });
    }
  }

  /** Shows the lamps as they are now. */
  showTable(renderer: WebGLRenderer, table: Texture): void {
    this.#part(0, 0, this.tableWidth, 1);
    this.#table.draw(renderer, this.picture, { copied: table });
  }

  dispose(): void {
    for (const pass of [this.#shares, this.#table, this.#kept, ...this.#lookups.values()]) pass.dispose();
    for (const target of [this.picture, this.ready, this.#surfaces, this.#spare, ...this.#sums]) target.dispose();
    this.#screen.dispose();
  }

  /** Beside one another in the picture, six shares each. */
  get #layers(): number {
    return Math.ceil((this.#sums.length + (this.hasReady ? READY : 0)) / SUMS);
  }

  #part(x: number, y: number, width: number, height: number): void {
    this.picture.viewport.set(x, y, width, height);
    this.picture.scissor.set(x, y, width, height);
  }

  #lookup(sun: boolean, soft: boolean): FullScreen {
    const key = `${sun}${soft}`;
    const names = ['surfaces', 'sums', 'depths', 'first', 'strength', 'projection', 'axes', 'point', 'normal', 'bothSides', 'size', 'within', 'range', 'mostRise'];
    const uniforms = Object.fromEntries(names.map((name) => [name, { value: null }]));
    const defines = { ...(sun && { SUN: '' }), ...(soft && { SOFT: '' }) };
    const pass = this.#lookups.get(key) ?? new FullScreen(this.#screen, seenSurface + lookupShader, uniforms, defines);
    this.#lookups.set(key, pass);
    return pass;
  }
}

const isSame = (a: Matrix4, b: Matrix4) => a.elements.every((x, i) => Math.abs(x - b.elements[i]!) <= ROUNDING * (1 + Math.abs(x)));

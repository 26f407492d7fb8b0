// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  type BufferGeometry,
  type Camera,
  DataTexture,
  DoubleSide,
  Group,
  type Material,
  type Object3DEventMap,
  Vector3,
  type WebGLRenderer,
} from 'three';
import type { PackConnection } from '../core/connection.js';
import {
  type ConnectionEvent,
  type FailureEvent,
  type LightEvent,
  type MeshEvent,
  type PackEvent,
  type Progress,
  type Strategy,
  type UpdateEvent,
  payload,
} from '../core/protocol.js';
import type { DirectLight, Shadows } from './direct/direct_light.js';
import type { Lamp } from './direct/lamp.js';
import { DIRECT_KIT } from './direct_kit.js';
import { disposeAll } from './dispose.js';
import type { Environment } from './environment.js';
import { assetOf } from './extensions.js';
import { FrameScheduler, type FrameTask } from './frame_scheduler.js';
import { HandOver } from './hand_over.js';
import { LightwellLight, type LightLookup } from './light.js';
import type { LightGroups } from './light_groups.js';
import { checkSize, LightRefinement } from './light_refinement.js';
import { boundsOf, MeshRefinement } from './mesh_refinement.js';
import { materialsOf, meshesIn } from './meshes.js';
import type { Opening } from './opening.js';
import { messageOf } from './pack_error.js';
import type { Refinement } from './refinement.js';
import type { Parts } from './parts.js';
import { TextureRefinement } from './texture_refinement.js';
import type { UploadBudget } from './upload_budget.js';
import { viewWeights } from './view_weights.js';

export interface LightwellSceneEventMap extends Object3DEventMap {
  /** The picture has changed: where frames are drawn on demand, draw one. */
  change: object;
  /** Meshes have more faces from now on: shadows drawn on demand are to be drawn anew. */
  geometry: object;
  progress: { progress: Progress };
  connection: { state: ConnectionEvent['state'] };
  /** Everything has come and has reached the GPU. */
  complete: object;
  /** No more will come, or an image could not be read. */
  failure: { reason: FailureEvent['reason']; message: string };
}

export interface SceneOptions {
  /** Let ambient occlusion maps darken the light of the grid, which holds the occlusion of all that was baked already. */
  ambientOcclusion?: boolean;
  /** How the light between the nodes of the grid is found; `trilinear` when it is left out. */
  lookup?: LightLookup;
  /** Of how many million pixels an image may be; a larger one stays as coarse as it begins. 64 when it is left out or 0. */
  maxImageMegapixels?: number;
}

/** As the baker has it. The memory for an image is taken before it comes, on the word of the pack. */
const USUAL_MEGAPIXELS = 64;

/** The images of materials, and of what surrounds the scene. */
type Images = Map<number, TextureRefinement | Environment>;

/**
 * A pack in a three.js scene. It refines itself, whoever draws it: in each of the browser's animation frames at most 256 KB go to
 * the renderer's GPU, into buffers and textures that have their final sizes from the start; a picture is worth drawing only at a
 * `change`. It may be moved, turned and scaled; its light follows.
 */
export class LightwellScene extends Group<LightwellSceneEventMap> {
  /** The baked light. Objects of the user's own within its bounds are lit by it. */
  readonly grids: LightwellLight[];
  /** The lamps that shine directly, and the sky where its light is apart. */
  readonly lamps: Lamp[] = [];
  readonly opening: Opening;
  /** Stops of exposure that the baker chose. */
  readonly exposure: number;
  /**
   * What surrounds the scene, where the pack has a picture of that: its `texture` is for `scene.environment`, which then is what metals
   * and gloss mirror, as far as the baked light lets it, and for `scene.background`. It gets sharper in its place.
   */
  readonly environment: Environment | undefined;
  /** What tells apart what the file has as parts and the pack shows in one mesh: scenes of very many parts. */
  parts?: Parts;
  /** The final bounds of the pack's meshes, in the pack's space. */
  readonly bounds: Box3;
  /** What the pack is about: the part that its first grid covers. A ground may reach far beyond it. */
  readonly focus: Box3;
  readonly #connection: PackConnection;
  readonly #renderer: WebGLRenderer;
  readonly #meshes = new Map<number, MeshRefinement>();
  readonly #images: Images;
  readonly #lights = new Map<number, LightRefinement>();
  readonly #groups: LightGroups | null;
  #direct: DirectLight | null = null;
  #links: Float32Array[] = [];
  #resolveLinks: (ends: Float32Array[]) => void = () => {};
  readonly #handOver: HandOver;
  readonly #uploads: FrameTask;
  #received = false;
  #complete = false;
  #wireframe = false;
  #edges: Promise<void> | null = null;

  private constructor(
    opening: Opening,
    images: Images,
    environment: Environment | undefined,
    grids: LightwellLight[],
    groups: LightGroups | null,
    connection: PackConnection,
    renderer: WebGLRenderer,
    options: SceneOptions,
  ) {
    super();
    this.#groups = groups;
    this.opening = opening;
    this.#images = images;
    this.environment = environment;
    this.#connection = connection;
    this.#renderer = renderer;
    this.#handOver = new HandOver(renderer);
    this.#uploads = FrameScheduler.of(renderer).add(({ bytes }) => this.#refine(bytes));
    renderer.domElement.addEventListener('webglcontextrestored', this.#restart);
    this.add(opening.gltf.scene);
    const { origin } = opening.extensions.LIGHTWELL_streams ?? {};
    if (origin) opening.gltf.scene.position.set(...origin).negate();
    prepareMeshes(opening.gltf.scene, options.ambientOcclusion ?? false);
    this.bounds = finalBounds(opening);
    this.focus = focusOf(opening, this.bounds);
    this.exposure = opening.extensions.LIGHTWELL_streams?.exposure ?? 0;
    this.grids = grids.filter(({ definition }) => !definition.insteadOf);
    for (const grid of grids) this.#lights.set(assetOf(grid.definition), new LightRefinement(grid, renderer, groups === null));
    this.add(...this.grids);
  }

  /**
   * Prepares what the loader read, with the first state of each of its grids in their order; later events of the connection go to
   * `receive`. Throws, before anything goes to the GPU, when a grid is too large for it.
   */
  static async create(
    opening: Opening,
    lights: LightEvent[],
    connection: PackConnection,
    renderer: WebGLRenderer,
    options: SceneOptions,
  ) {
    const definitions = opening.extensions.LIGHTWELL_light_grids?.grids ?? [];
    const grouped = definitions.some(({ group, contains }) => group !== undefined || contains?.includes('indirect') === false);
    const groups = grouped ? new (await import('./light_groups.js')).LightGroups(definitions, lights) : null;
    const states = groups?.states() ?? lights;
    const grids = (groups?.definitions ?? definitions).map((grid, i) => new LightwellLight(grid, states[i]!, options.lookup));
    for (const { texture } of grids) checkSize(texture, renderer);
    const images: Images = new Map();
    const most = options.maxImageMegapixels || USUAL_MEGAPIXELS;
    const made = new Map<unknown, TextureRefinement>();
    for (const [asset, { extension, textures }] of opening.images) {
      const { width, height } = extension;
      const known = made.get(textures);
      if (known) images.set(asset, known);
      else if (width * height <= most * 2 ** 20) {
        const refinement = await TextureRefinement.create(textures, { width, height }, renderer);
        made.set(textures, refinement);
        images.set(asset, refinement);
      } else console.warn(`Lightwell: an image of ${width} x ${height} pixels stays coarse; maxImageMegapixels is ${most}`);
    }
    const surroundings = opening.extensions.LIGHTWELL_environment;
    const environment =
      surroundings && (await (await import('./environment.js')).Environment.create(DataTexture, surroundings, opening.gltf.parser));
    if (environment) images.set(environment.asset, environment);
    const scene = new LightwellScene(opening, images, environment, grids, groups, connection, renderer, options);
    const { LIGHTWELL_parts: parts } = opening.extensions;
    if (parts) scene.parts = new (await import('./parts.js')).Parts(parts, opening, Box3);
    const lamps = opening.extensions.LIGHTWELL_lamps?.lamps ?? [];
    if (lamps.length > 0 || groups?.skyIsApart) {
      const { DirectLight } = await import('./direct/direct_light.js');
      scene.#shine(new DirectLight(DIRECT_KIT, lamps, scene.#surroundings(grids)));
    }
    return scene;
  }

  #surroundings(grids: LightwellLight[]): ConstructorParameters<typeof DirectLight>[2] {
    const { bounds, focus, opening, environment } = this;
    const [renderer, scheduler] = [this.#renderer, FrameScheduler.of(this.#renderer)];
    return { renderer, scheduler, bounds, focus, opening, environment, grids, changed: () => this.#changed() };
  }

  #shine(direct: DirectLight): void {
    this.#direct = direct;
    this.lamps.push(...direct.lamps);
    this.add(direct.hook, direct.carrier, ...direct.lamps);
  }

  /**
   * How lamps cast shadows: from all of their surface, from their middle, or not at all. Making them softer takes so many milliseconds of
   * the GPU's time in a frame; 4 when it is left out.
   */
  setShadows(shadows: Shadows, milliseconds?: number): void {
    this.#direct?.setShadows(shadows, milliseconds);
  }

  /** From how many points of each lamp the shadows in the picture are, at least; Infinity once there are as many as there will be. */
  get shadowSamples(): number {
    return this.#direct?.samples ?? Infinity;
  }

  /** By how many steps that are just not seen those shadows may be off, at most; Infinity while that is not known. */
  get shadowError(): number {
    return this.#direct?.error ?? 0;
  }

  setStrategy(strategy: Strategy): void {
    this.#connection.setStrategy(strategy);
  }

  /**
   * Shows the triangles' edges. A browser with WEBGL_polygon_mode does so at once and without further memory. In another the
   * edges are shown once all has come, and the first time takes GPU memory for them: 36 bytes a face. Resolves when what can be shown so is.
   */
  async setWireframe(wireframe: boolean): Promise<void> {
    if (!wireframe && !this.#edges) return;
    this.#wireframe = wireframe;
    await (this.#edges = this.#showEdges());
  }

  async #showEdges(): Promise<void> {
    const { showEdges } = await import('./wireframe.js');
    showEdges(this.opening.gltf.scene, this.#renderer, this.#wireframe, this.#complete);
    this.#changed();
  }

  /** The groups of the pack's lamps: see `setLightGroup`. */
  get lightGroups(): string[] {
    return this.#groups?.names ?? [];
  }

  /** Whether the sky's own light may be changed apart from the rest: see `setSkyLight`. */
  get skyIsApart(): boolean {
    return this.#groups?.skyIsApart ?? false;
  }

  /** Multiplies all light of a group of lamps, bounced or not, for each colour; 0 switches it off. Throws when there is none of the name. */
  setLightGroup(name: string, factor: number | [number, number, number]): void {
    this.#changeGroups((groups) => groups.set(name, factor, this.lamps, this.opening));
  }

  #changeGroups(change: (groups: LightGroups) => void): void {
    const groups = this.#groups;
    if (groups === null) throw new Error('the light of this pack is not divided');
    change(groups);
    for (const state of groups.states()) this.#lights.get(state.asset)!.receive(state);
    this.#uploads.request();
    this.#changed();
  }

  /**
   * Multiplies the sky's own light, for each colour, in a pack that has it apart from what surfaces reflect; for who shows it by other
   * means. Throws when it is not apart.
   */
  setSkyLight(factor: number | [number, number, number]): void {
    this.#changeGroups((groups) => groups.setSky(factor, this.lamps));
  }

  /**
   * The links between neighbours of the grids that walls block, as far as they have come: of each grid x, y, z of both ends of each, in the
   * pack's space. They are sent to keep what lies behind a wall apart from what lies before it.
   */
  blockedLinks(): Promise<Float32Array[]> {
    this.#links = [];
    for (const { definition } of this.grids) this.#connection.askForLinks(assetOf(definition));
    return new Promise((resolve) => (this.#resolveLinks = resolve));
  }

  /** Asks for no more until `resume`, and makes shadows no softer. */
  pause(): void {
    this.#connection.pause();
    this.#direct?.pause();
  }

  resume(): void {
    this.#connection.resume();
    this.#direct?.resume();
  }

  /** Lets what matters most to this camera's picture come first. Call it when the view has changed much, not each frame. */
  setView(camera: Camera, heightInPixels: number): void {
    const weights = viewWeights(this.opening, this.grids, camera, heightInPixels);
    this.#connection.setWeights(this.#groups?.weigh(weights) ?? weights);
  }

  /** Throws: a stream fills one object. */
  override clone(): never {
    throw new Error('LightwellScene: cannot be cloned, since it streams; load it again');
  }

  /** Ends the streaming and gives back what the GPU holds. */
  override dispose(): void {
    super.dispose();
    this.#connection.close();
    this.#uploads.dispose();
    this.#handOver.dispose();
    this.#renderer.domElement.removeEventListener('webglcontextrestored', this.#restart);
    for (const refinement of this.#refinements()) refinement.dispose();
    this.#direct?.dispose();
    disposeAll(this.opening.gltf.scene);
  }

  /** Begins again with what was on its way to a GPU that has lost everything. */
  readonly #restart = (): void => {
    for (const refinement of this.#refinements()) refinement.restart();
    this.#direct?.restart();
  };

  /** Takes an event of the connection, which the loader passes on. */
  receive(event: PackEvent): void {
    switch (event.type) {
      case 'opening':
        return;
      case 'links':
        this.#links.push(event.ends);
        return this.#links.length === this.grids.length ? this.#resolveLinks(this.#links) : undefined;
      case 'progress':
        return void this.dispatchEvent({ type: 'progress', progress: event.progress });
      case 'connection':
        this.#received = event.state === 'complete';
        this.dispatchEvent({ type: 'connection', state: event.state });
        return this.#uploads.request();
      case 'failure':
        return void this.dispatchEvent({ type: 'failure', reason: event.reason, message: event.message });
      default:
        return this.#update(event);
    }
  }

  /** An update that does not fit the opening ends the streaming. */
  #update(event: UpdateEvent): void {
    try {
      this.#apply(event);
    } catch (error) {
      this.#connection.close();
      this.#fail(error);
    }
  }

  #apply(event: UpdateEvent): void {
    switch (event.type) {
      case 'mesh':
        return this.#startMesh(event);
      case 'range':
      case 'draw':
        return this.#refineBy(event, this.#meshes.get(event.asset));
      case 'light':
        return this.#refineLight(event);
      case 'parts':
        void this.parts?.receive(event);
        return this.#refineBy(event, undefined);
      case 'texture':
        return this.#refineBy(event, this.#images.get(event.asset));
    }
  }

  /** What groups send is added up at once; the sum costs the sender nothing. */
  #refineLight(event: LightEvent): void {
    if (this.#groups === null) return this.#refineBy(event, this.#lights.get(event.asset));
    this.#connection.consumed(event.atlas.byteLength);
    for (const sum of this.#groups.receive(event)) this.#refineBy(sum, this.#lights.get(sum.asset));
  }

  #fail(error: unknown): void {
    this.dispatchEvent({ type: 'failure', reason: 'unreadable', message: messageOf(error) });
  }

  /** Hands over what a frame has room for. */
  #refine(budget: UploadBudget): void {
    const touched: BufferGeometry[] = [];
    let [changed, grown, pending, consumed] = [false, false, false, 0];
    for (const refinement of this.#refinements()) {
      const left = budget.left;
      const advanced = refinement.advance(budget);
      changed ||= advanced;
      if (refinement instanceof MeshRefinement) {
        grown ||= advanced;
        if (budget.left < left) touched.push(refinement.geometries[0]!);
      }
      consumed += refinement.takeConsumed();
      pending ||= refinement.pending;
    }
    this.#handOver.run(touched);
    if (consumed > 0) this.#connection.consumed(consumed);
    if (grown) {
      this.#direct?.grow();
      this.dispatchEvent({ type: 'geometry' });
    }
    if (changed) this.#changed();
    if (pending) this.#uploads.request();
    else if (this.#received && !this.#complete) this.#onComplete();
  }

  #onComplete(): void {
    this.#complete = true;
    this.#direct?.finish();
    if (this.#wireframe) this.#showEdges();
    this.dispatchEvent({ type: 'complete' });
  }

  /** In the order in which they share a frame's bytes: light is small and seen everywhere. */
  *#refinements(): Generator<Refinement> {
    yield* this.#lights.values();
    yield* this.#meshes.values();
    yield* new Set(this.#images.values());
  }

  /** Bytes that nothing in the scene shows count as consumed: otherwise the sender would wait for them. */
  #refineBy<Event extends UpdateEvent>(
    event: Event,
    refinement: { receive(event: Event): void | Promise<void> } | undefined,
  ): void {
    if (refinement === undefined) this.#connection.consumed(payload(event)?.byteLength ?? 0);
    else refinement.receive(event)?.catch((error: unknown) => this.#fail(error));
    this.#uploads.request();
  }

  #startMesh(layout: MeshEvent): void {
    const regions = this.opening.primitives.get(layout.asset);
    if (regions === undefined) return;
    const refinement = new MeshRefinement(layout, regions);
    regions.forEach(({ bend, meshes, base }, region) => {
      const geometry = refinement.geometries[region]!;
      bend?.(geometry);
      for (const mesh of meshes) mesh.geometry = geometry;
      base.dispose();
    });
    this.#handOver.run(refinement.geometries.slice(0, 1));
    this.#meshes.set(layout.asset, refinement);
  }

  #changed(): void {
    this.dispatchEvent({ type: 'change' });
  }
}

function focusOf({ extensions }: Opening, bounds: Box3): Box3 {
  const grids = [...(extensions.LIGHTWELL_light_grids?.grids ?? [])];
  grids.sort((a, b) => (b.priority ?? 0) - (a.priority ?? 0));
  if (grids[0] === undefined) return bounds;
  const { min, cell, nodes } = grids[0];
  const first = new Vector3(...min);
  const size = new Vector3(...nodes).subScalar(1).multiply(new Vector3(...cell));
  return new Box3(first, size.add(first)).intersect(bounds);
}

/** Surfaces cast and take shadows on both sides, as in the bake. */
function prepareMeshes(root: Group, ambientOcclusion: boolean): void {
  for (const mesh of meshesIn(root)) {
    mesh.castShadow = mesh.receiveShadow = true;
    for (const material of materialsOf(mesh) as (Material & { aoMapIntensity?: number })[]) {
      material.shadowSide = DoubleSide;
      // What is unlit looks as its file has it, however the rest is exposed.
      if ('isMeshBasicMaterial' in material) material.toneMapped = false;
      if (!ambientOcclusion && material.aoMapIntensity !== undefined) material.aoMapIntensity = 0;
    }
  }
}

/** The box of all meshes at their finest: the coarse ones may be smaller. */
function finalBounds(opening: Opening): Box3 {
  opening.gltf.scene.updateMatrixWorld(true);
  const bounds = new Box3().setFromObject(opening.gltf.scene);
  for (const { extension, meshes } of [...opening.primitives.values()].flat())
    if (!extension.deformation) for (const mesh of meshes) bounds.union(boundsOf(extension).applyMatrix4(mesh.matrixWorld));
  return bounds;
}

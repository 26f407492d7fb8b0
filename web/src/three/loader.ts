// SPDX-License-Identifier: Apache-2.0
import { Loader, type LoadingManager, REVISION, type WebGLRenderer } from 'three';
import { type ConnectionOptions, PackConnection, reporting } from '../core/connection.js';
import type { ConnectionEvent, LightEvent, MeshEvent, PackEvent } from '../core/protocol.js';
import { assetOf } from './extensions.js';
import { readOpening } from './opening.js';
import { messageOf, PackError, reasonOf } from './pack_error.js';
import { LightwellScene, type SceneOptions } from './scene.js';

export interface LoaderOptions extends ConnectionOptions, SceneOptions {
  /** Try another three.js than the one that package.json asks for: what it draws may be wrong. */
  anyThree?: boolean;
  /** Called with the connection's state until the scene is there, which has an event for it. */
  onConnection?: (state: ConnectionEvent['state']) => void;
}

/** Shaders are replaced (shader_chunks.ts), and those of another revision are others. */
const KNOWN_REVISION = '187';

/**
 * Loads a pack. What it gives can be shown as soon as the pack's first kilobytes are here and refines itself from then on:
 *
 *     const loader = new LightwellLoader().setRenderer(renderer);
 *     scene.add(await loader.loadAsync('room.lw.glb'));
 *
 * Create it before the renderer compiles materials that the light is to reach.
 */
export class LightwellLoader extends Loader<LightwellScene> {
  #renderer: WebGLRenderer | null = null;
  #options: LoaderOptions = {};
  #abort = new AbortController();

  constructor(manager?: LoadingManager) {
    super(manager);
  }

  /** The renderer that will show what is loaded: textures are filled in place, which needs it. */
  setRenderer(renderer: WebGLRenderer): this {
    this.#renderer = renderer;
    return this;
  }

  setOptions(options: LoaderOptions): this {
    this.#options = options;
    return this;
  }

  /** Ends the loads that are under way: they fail with an AbortError. */
  override abort(): this {
    this.#abort.abort();
    this.#abort = new AbortController();
    return this;
  }

  /** `onError` is given a PackError, which says the reason. */
  override load(
    url: string,
    onLoad: (scene: LightwellScene) => void,
    onProgress?: (event: globalThis.ProgressEvent) => void,
    onError?: (error: unknown) => void,
  ): void {
    const item = this.manager.resolveURL(this.path + url);
    this.manager.itemStart(item);
    this.#load(item, this.#abort.signal, onProgress)
      .then(onLoad)
      .catch((error: unknown) => {
        this.manager.itemError(item);
        if (onError === undefined) console.error(error);
        else onError(error);
      })
      .finally(() => this.manager.itemEnd(item));
  }

  /** The scene's events begin after `onLoad`, so that none is missed. */
  async #load(
    url: string,
    signal: AbortSignal,
    onProgress?: (event: globalThis.ProgressEvent) => void,
  ): Promise<LightwellScene> {
    const renderer = this.#renderer;
    if (renderer === null || !('isWebGLRenderer' in renderer))
      throw new Error('LightwellLoader: call setRenderer before loading, with a WebGLRenderer (no WebGPURenderer)');
    if (REVISION !== KNOWN_REVISION && this.#options.anyThree !== true)
      throw new Error(`three.js ${REVISION} is not ${KNOWN_REVISION}: pictures may be wrong; anyThree shows them`);
    const connection = new PackConnection(url, this.#options);
    let scene: LightwellScene | null = null;
    try {
      const inbox = new Inbox(connection, signal, onProgress, this.#options.onConnection);
      const { glb } = await inbox.take((event) => event.type === 'opening');
      const opening = await readOpening(glb, this.manager);
      // The first state of a light comes with the opening, so it is close behind. A picture without it would be black.
      const lights: LightEvent[] = [];
      for (const asset of (opening.extensions.LIGHTWELL_light_grids?.grids ?? []).map(assetOf)) {
        const light = await inbox.take((event): event is LightEvent => event.type === 'light' && event.asset === asset);
        connection.consumed(light.atlas.byteLength);
        lights.push(light);
      }
      const created = (scene = await LightwellScene.create(opening, lights, connection, renderer, this.#options));
      // So are the sizes of the meshes: all buffers are there with the first frame.
      for (const asset of opening.primitives.keys())
        scene.receive(await inbox.take((event): event is MeshEvent => event.type === 'mesh' && event.asset === asset));
      signal.throwIfAborted();
      setTimeout(() => inbox.forward((event) => created.receive(event)));
      return scene;
    } catch (error) {
      connection.close();
      scene?.dispose();
      throw signal.aborted ? signal.reason : new PackError(`${url}: ${messageOf(error)}`, reasonOf(error));
    }
  }
}

/** Keeps what a connection says until somebody wants it. */
class Inbox {
  readonly #connection: PackConnection;
  readonly #signal: AbortSignal;
  readonly #events: PackEvent[] = [];
  #look: () => void = () => {};

  constructor(
    connection: PackConnection,
    signal: AbortSignal,
    onProgress?: (event: globalThis.ProgressEvent) => void,
    onConnection?: LoaderOptions['onConnection'],
  ) {
    this.#connection = connection;
    this.#signal = signal;
    connection.onEvent = (event) => {
      if (event.type === 'progress') onProgress?.(asProgressEvent(event.progress.bytes));
      if (event.type === 'connection') onConnection?.(event.state);
      this.#events.push(event);
      this.#look();
    };
  }

  /** Takes the first event that is `wanted` out, after waiting for it; rejects when the connection fails or the load is aborted instead. */
  take<Event extends PackEvent>(wanted: (event: PackEvent) => event is Event): Promise<Event> {
    return new Promise((resolve, reject) => {
      const look = (this.#look = () => {
        const event = this.#events.find(wanted);
        const failure = this.#events.find((other) => other.type === 'failure');
        if (this.#signal.aborted) reject(this.#signal.reason);
        else if (event !== undefined) {
          this.#events.splice(this.#events.indexOf(event), 1);
          resolve(event);
        } else if (failure !== undefined) reject(new PackError(failure.message, failure.reason));
        else return;
        this.#look = () => {};
        this.#signal.removeEventListener('abort', look);
      });
      this.#signal.addEventListener('abort', look);
      look();
    });
  }

  /** Passes on what is left, and from then on every event as it comes. */
  forward(listener: (event: PackEvent) => void): void {
    this.#events.splice(0).forEach(reporting(listener));
    this.#connection.onEvent = listener;
  }
}

function asProgressEvent({ done, total }: { done: number; total: number }): globalThis.ProgressEvent {
  return new globalThis.ProgressEvent('progress', { lengthComputable: total > 0, loaded: done, total });
}

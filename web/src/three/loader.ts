// SPDX-License-Identifier: Apache-2.0
import { Loader, type LoadingManager, type WebGLRenderer } from 'three';
import { type ConnectionOptions, PackConnection } from '../core/connection.js';
import type { LightEvent, PackEvent } from '../core/protocol.js';
import { readOpening } from './opening.js';
import { LightwellScene, type SceneOptions } from './scene.js';

/** The first state of the lights is waited for this long, in milliseconds. */
const LIGHT_PATIENCE = 1000;

export type LoaderOptions = ConnectionOptions & SceneOptions;

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

  override load(
    url: string,
    onLoad: (scene: LightwellScene) => void,
    onProgress?: (event: globalThis.ProgressEvent) => void,
    onError?: (error: unknown) => void,
  ): void {
    const item = this.manager.resolveURL(this.path + url);
    this.manager.itemStart(item);
    this.#load(item, onProgress)
      .then(onLoad)
      .catch((error: unknown) => {
        this.manager.itemError(item);
        if (onError === undefined) console.error(error);
        else onError(error);
      })
      .finally(() => this.manager.itemEnd(item));
  }

  /** The scene's events begin after `onLoad`, so that nobody misses one. */
  async #load(url: string, onProgress?: (event: globalThis.ProgressEvent) => void): Promise<LightwellScene> {
    const renderer = this.#renderer;
    if (renderer === null) throw new Error('LightwellLoader: call setRenderer before loading');
    const connection = new PackConnection(url, this.#options);
    try {
      const { glb, later } = await receiveOpening(url, connection, onProgress);
      const opening = await readOpening(glb, this.manager);
      const grids = opening.extensions.LIGHTWELL_light_grids?.grids ?? [];
      const lights = await receiveLights(grids.map(({ stream }) => stream), connection, later);
      const scene = await LightwellScene.create(opening, lights, connection, renderer, this.#options);
      setTimeout(() => {
        later.forEach((event) => scene.receive(event));
        connection.onEvent = (event) => scene.receive(event);
      });
      return scene;
    } catch (error) {
      connection.close();
      throw error;
    }
  }
}

/** Waits for the opening; what comes behind it is kept for the scene. */
function receiveOpening(
  url: string,
  connection: PackConnection,
  onProgress?: (event: globalThis.ProgressEvent) => void,
): Promise<{ glb: ArrayBuffer; later: PackEvent[] }> {
  const later: PackEvent[] = [];
  return new Promise((resolve, reject) => {
    connection.onEvent = (event) => {
      if (event.type === 'opening') resolve({ glb: event.glb, later });
      else if (event.type === 'failure') reject(new Error(`${url}: ${event.message}`));
      else if (event.type === 'progress') onProgress?.(asProgressEvent(event.progress.bytes));
      later.push(event);
    };
  });
}

/**
 * Takes the first state of each light out of what has come, after waiting for it a little: it lies close behind the opening, and
 * a first picture without it would be black.
 */
function receiveLights(streams: number[], connection: PackConnection, later: PackEvent[]): Promise<LightEvent[]> {
  const firstOf = (stream: number) => later.find((event): event is LightEvent => event.type === 'light' && event.stream === stream);
  const keep = connection.onEvent;
  return new Promise((resolve) => {
    const settle = () => {
      clearTimeout(timer);
      connection.onEvent = keep;
      const lights = streams.map(firstOf).filter((event) => event !== undefined);
      for (const light of lights) later.splice(later.indexOf(light), 1);
      resolve(lights);
    };
    const timer = setTimeout(settle, LIGHT_PATIENCE);
    const settleWhenThere = () => streams.every(firstOf) && settle();
    connection.onEvent = (event) => {
      keep(event);
      settleWhenThere();
    };
    settleWhenThere();
  });
}

function asProgressEvent({ done, total }: { done: number; total: number }): globalThis.ProgressEvent {
  return new globalThis.ProgressEvent('progress', { lengthComputable: total > 0, loaded: done, total });
}

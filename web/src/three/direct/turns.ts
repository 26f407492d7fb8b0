// SPDX-License-Identifier: Apache-2.0
import type { Camera } from 'three';

/** Tells cameras that draw one after the other, for ever: a picture that a refinement asked for would undo it. */
export class Turns {
  /** The two views before. */
  #views: string[] = [];

  /** Notes that a camera draws, which has moved or is another than before; says whether it takes turns with another one. */
  take(camera: Camera, moved: boolean): boolean {
    const view = camera.uuid;
    const turns = moved && this.#views[0] !== undefined && this.#views[1] === view && this.#views[0] !== view;
    if (moved) this.#views = [view, this.#views[0] ?? view];
    else this.#views = [view];
    return turns;
  }
}

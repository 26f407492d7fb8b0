// SPDX-License-Identifier: Apache-2.0
import type { AnimationClip, Object3D } from 'three';
import type { LightwellScene } from '../three/scene.js';
import { beginsWith } from './attribute_life.js';
import type { LightwellView } from './lightwell_view.js';
import { whenMotionIsSeen } from './motion.js';

/** No frame counts for more, in seconds: after a pause of the page nothing jumps. */
const LONGEST_FRAME = 0.1;

/** What the keys of a track move: a vector, a quaternion, or the weights of morph targets. */
type Moved = { fromArray(values: ArrayLike<number>): unknown; toArray(): number[] } | number[];

interface Channel {
  moved: Moved;
  /** As the file has it, which is what was baked. */
  rest: number[];
  /** Its values at a time in seconds. */
  at(time: number): ArrayLike<number>;
}

/** Plays the pack's animation of the name that the attribute `animation` has, or its first one, again and again, where it is seen. */
export function animate(view: LightwellView): void {
  const end = beginsWith(view, 'animation');
  if (end === null || end.aborted) return;
  let playing: Playing | null = null;
  let [frame, last] = [0, 0];
  const step = () => {
    const now = performance.now();
    const seconds = Math.min(LONGEST_FRAME, (now - last) / 1000);
    last = now;
    const name = view.getAttribute('animation') ?? '';
    if (playing?.of(view.pack, name) !== true) {
      playing?.rest();
      playing = view.pack && new Playing(view.pack, name);
    }
    if (playing?.advance(seconds) === true) {
      view.invalidate();
      // A frame when the GPU has time for one: what streams in goes on meanwhile.
      playing.pack.dispatchEvent({ type: 'change' });
    }
    frame = requestAnimationFrame(step);
  };
  whenMotionIsSeen(view, end, (seen) => {
    cancelAnimationFrame(frame);
    last = performance.now();
    if (seen) step();
  });
  end.addEventListener('abort', () => {
    cancelAnimationFrame(frame);
    playing?.rest();
    view.invalidate();
  });
}

/** An animation of a pack, and where it is. */
class Playing {
  readonly #channels: Channel[];
  readonly #seconds: number;
  #time = 0;

  constructor(
    readonly pack: LightwellScene,
    readonly name: string,
  ) {
    const { animations, scene } = pack.opening.gltf;
    const clip = name === '' ? animations[0] : animations.find((animation) => animation.name === name);
    this.#seconds = clip?.duration ?? 0;
    this.#channels = clip === undefined ? [] : channelsOf(clip, scene);
    if (clip === undefined && name !== '')
      console.warn(`lightwell-view: no animation "${name}", but: ${animations.map((animation) => animation.name).join(', ')}`);
  }

  of(pack: LightwellScene | null, name: string): boolean {
    return this.pack === pack && this.name === name;
  }

  /** False when nothing moves. */
  advance(seconds: number): boolean {
    if (this.#channels.length === 0) return false;
    this.#time = (this.#time + seconds) % (this.#seconds || 1);
    for (const { moved, at } of this.#channels) put(moved, at(this.#time));
    return true;
  }

  rest(): void {
    for (const { moved, rest } of this.#channels) put(moved, rest);
  }
}

function put(moved: Moved, values: ArrayLike<number>): void {
  if (Array.isArray(moved)) for (let i = 0; i < moved.length; i++) moved[i] = values[i] ?? 0;
  else moved.fromArray(values);
}

/** three.js names a track by its object, by name or by uuid, and the object's property. */
function channelsOf(clip: AnimationClip, root: Object3D): Channel[] {
  return clip.tracks.flatMap((track) => {
    const dot = track.name.lastIndexOf('.');
    const owner = track.name.slice(0, dot);
    const object = root.getObjectByProperty('uuid', owner) ?? root.getObjectByName(owner);
    const moved = object?.[track.name.slice(dot + 1) as keyof Object3D] as Moved | undefined;
    if (moved === undefined) return [];
    const keys = (track as unknown as { createInterpolant(): { evaluate(time: number): ArrayLike<number> } }).createInterpolant();
    return { moved, rest: Array.isArray(moved) ? [...moved] : moved.toArray(), at: (time: number) => keys.evaluate(time) };
  });
}

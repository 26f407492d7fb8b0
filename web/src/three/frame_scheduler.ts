// SPDX-License-Identifier: Apache-2.0
import type { WebGLRenderer } from 'three';
import { UploadBudget } from './upload_budget.js';

/** The browser's usual time from frame to frame, in milliseconds. */
export const FRAME = 1000 / 60;
/** What seems to take the GPU longer than this, in milliseconds, is taken for a page that was hidden meanwhile. */
const LONGEST_RUN = 5000;

/** One of the browser's animation frames. */
export class Frame {
  /** What all tasks together may still hand to the GPU. */
  readonly bytes = new UploadBudget();

  constructor(readonly time = performance.now()) {}
}

const schedulers = new WeakMap<WebGLRenderer, FrameScheduler>();

/**
 * Divides a renderer's frames among tasks. It asks the browser for a frame only while a task wants one. In a frame the tasks run
 * one after another, the latest first: so a page that adds its drawing before anything else draws what was just handed over.
 */
export class FrameScheduler {
  readonly #gl: WebGL2RenderingContext;
  readonly #tasks = new Set<FrameTask>();
  #fences: { sync: WebGLSync | null; then: () => void }[] = [];
  #request = 0;

  private constructor(renderer: WebGLRenderer) {
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
  }

  /** The one scheduler of a renderer. */
  static of(renderer: WebGLRenderer): FrameScheduler {
    const scheduler = schedulers.get(renderer) ?? new FrameScheduler(renderer);
    schedulers.set(renderer, scheduler);
    return scheduler;
  }

  /**
   * Adds a task whose `work` is called once for each time that it is requested. Where `milliseconds` are given, it takes no more
   * than that of the GPU's time in a frame, on average: after a longer run it rests.
   */
  add(work: (frame: Frame) => void, milliseconds = Infinity): FrameTask {
    const task = new FrameTask(this, work, milliseconds);
    this.#tasks.add(task);
    return task;
  }

  remove(task: FrameTask): void {
    this.#tasks.delete(task);
  }

  /** Asks the browser for a frame. */
  wake(): void {
    if (this.#request === 0) this.#request = requestAnimationFrame((time) => this.#run(new Frame(time)));
  }

  /** Calls back in the first frame in which the GPU is done with all that it was told, or lost. */
  whenDone(then: () => void): void {
    this.#fences.push({ sync: this.#gl.fenceSync(this.#gl.SYNC_GPU_COMMANDS_COMPLETE, 0), then });
    this.#gl.flush();
    this.wake();
  }

  #run(frame: Frame): void {
    this.#request = 0;
    try {
      this.#passFences();
      for (const task of [...this.#tasks].reverse()) if (task.due) task.run(frame);
    } finally {
      if (this.#fences.length > 0 || [...this.#tasks].some(({ wanted }) => wanted)) this.wake();
    }
  }

  #passFences(): void {
    const gl = this.#gl;
    for (const fence of this.#fences.splice(0)) {
      if (fence.sync !== null && gl.getSyncParameter(fence.sync, gl.SYNC_STATUS) === gl.UNSIGNALED) this.#fences.push(fence);
      else {
        gl.deleteSync(fence.sync);
        fence.then();
      }
    }
  }
}

/** Something that is done in frames, when it is asked for. */
export class FrameTask {
  readonly #scheduler: FrameScheduler;
  readonly #work: (frame: Frame) => void;
  #wanted = false;
  #urgent = false;
  /** When the last run ended here, and how long the GPU took for it from then on: endless until it is done. */
  #ended = -Infinity;
  #duration = 0;

  /** `milliseconds`: of the GPU's time in a frame, at most. */
  constructor(scheduler: FrameScheduler, work: (frame: Frame) => void, public milliseconds: number) {
    this.#scheduler = scheduler;
    this.#work = work;
  }

  get wanted(): boolean {
    return this.#wanted;
  }

  /** Whether it is wanted and, unless that is urgent, has rested: its runs take their share of the frames since the last one. */
  get due(): boolean {
    const rested = performance.now() >= this.#ended + (this.#duration * FRAME) / this.milliseconds;
    return this.#wanted && (this.#urgent || rested);
  }

  /** Wants a run in the next frame that has time for it. */
  request(): void {
    this.#wanted = true;
    this.#scheduler.wake();
  }

  /** Wants a run in the next frame, whatever the last one took. */
  requestNow(): void {
    this.#urgent = true;
    this.request();
  }

  /** Wants no run any more. */
  cancel(): void {
    this.#wanted = this.#urgent = false;
  }

  /** Runs at once; what was asked for is done by that. */
  run(frame = new Frame()): void {
    this.cancel();
    this.#work(frame);
    if (this.milliseconds === Infinity) return;
    const ended = (this.#ended = performance.now());
    this.#duration = Infinity;
    this.#scheduler.whenDone(() => {
      if (ended === this.#ended) this.#duration = Math.min(LONGEST_RUN, performance.now() - ended);
    });
  }

  dispose(): void {
    this.cancel();
    this.#scheduler.remove(this);
  }
}

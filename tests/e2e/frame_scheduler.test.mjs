// SPDX-License-Identifier: Apache-2.0
//
// The frame scheduler without a browser: frames come when the test says so, and the GPU is as slow as it says.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { temporaryFolder } from './packs.mjs';
import { bundle } from './test_page.mjs';

const folder = temporaryFolder();
writeFileSync(`${folder}/frame_scheduler.mjs`, await bundle('web/src/three/frame_scheduler.ts'));
const { FRAME, FrameScheduler } = await import(`${folder}/frame_scheduler.mjs`);

const BYTES_PER_FRAME = 256 * 1024;
/** Milliseconds from frame to frame: those of 60 a second. */
const TICK = 1000 / 60;

/** A clock, a browser that counts in `asked` what it is asked for, and a GPU that is done `gpu.milliseconds` after it was told. */
function makeWorld(t) {
  let now = 0;
  const asked = [];
  const gpu = { milliseconds: 0 };
  t.mock.method(performance, 'now', () => now);
  globalThis.requestAnimationFrame = (call) => asked.push(call);
  t.after(() => delete globalThis.requestAnimationFrame);
  const gl = {
    UNSIGNALED: 0,
    fenceSync: () => ({ end: now + gpu.milliseconds }),
    getSyncParameter: ({ end }) => (now < end ? 0 : 1),
    deleteSync() {},
    flush() {},
  };
  /** Lets so many frames pass; gives how often the browser was asked for one. */
  const pass = (frames) => {
    let requests = 0;
    for (let i = 0; i < frames; i++) {
      now += TICK;
      const calls = asked.splice(0);
      requests += calls.length;
      for (const call of calls) call(now);
    }
    return requests;
  };
  const renderer = { getContext: () => gl };
  return { scheduler: FrameScheduler.of(renderer), renderer, asked, gpu, pass };
}

test('all who have to do with a renderer have one scheduler', (t) => {
  const { scheduler, renderer } = makeWorld(t);
  assert.equal(FrameScheduler.of(renderer), scheduler);
  assert.notEqual(FrameScheduler.of({ ...renderer }), scheduler);
});

test('tasks share one request, one frame and its bytes, the latest first', (t) => {
  const { scheduler, asked, pass } = makeWorld(t);
  const runs = [];
  const names = ['draw', 'first pack', 'second pack'];
  const tasks = names.map((name) => scheduler.add(({ bytes }) => runs.push([name, bytes.take(0.4 * BYTES_PER_FRAME)])));
  for (const task of tasks) task.request();
  assert.equal(asked.length, 1);
  assert.equal(pass(1), 1);
  assert.deepEqual(runs, [['second pack', true], ['first pack', true], ['draw', false]]);
});

test('nothing that is wanted is no frame', (t) => {
  const { scheduler, pass } = makeWorld(t);
  let runs = 0;
  const task = scheduler.add(() => runs++ < 3 && task.request());
  task.request();
  assert.equal(pass(100), 4);
  task.request();
  task.cancel();
  pass(2);
  assert.equal(runs, 4);
  task.dispose();
  task.request();
  assert.ok(pass(100) <= 1);
  assert.equal(runs, 4);
});

for (const milliseconds of [1, 4, FRAME / 2])
  for (const duration of [0.5, 3, 12, 100])
    test(`a task with ${milliseconds} ms of each frame whose runs take ${duration} ms keeps to that on average`, (t) => {
      const { scheduler, gpu, pass } = makeWorld(t);
      gpu.milliseconds = duration;
      let runs = 0;
      const task = scheduler.add(() => (runs++, task.request()), milliseconds);
      task.request();
      const frames = 3000;
      pass(frames);
      // The end of a run is seen up to a frame later, and the next run waits for the beginning of one.
      const apart = TICK * Math.max(1, (duration + TICK) / milliseconds);
      assert.ok(runs * duration <= milliseconds * frames + duration, `${runs} runs`);
      assert.ok(runs >= Math.floor((frames * TICK) / (apart + TICK)), `only ${runs} runs`);
    });

test('what is urgent does not rest', (t) => {
  const { scheduler, gpu, pass } = makeWorld(t);
  gpu.milliseconds = 1000;
  let runs = 0;
  const task = scheduler.add(() => runs++, 1);
  for (let i = 0; i < 5; i++) {
    task.requestNow();
    pass(1);
  }
  assert.equal(runs, 5);
  task.request();
  pass(5);
  assert.equal(runs, 5);
});

test('a task that runs out of turn has done what it was asked for', (t) => {
  const { scheduler, pass } = makeWorld(t);
  let runs = 0;
  const task = scheduler.add(() => runs++);
  task.request();
  task.run();
  pass(3);
  assert.equal(runs, 1);
});

test('a task that throws keeps no other from its frames', (t) => {
  const { scheduler, pass } = makeWorld(t);
  let runs = 0;
  const other = scheduler.add(() => runs++);
  const task = scheduler.add(() => {
    throw new Error('on purpose');
  });
  task.request();
  other.request();
  assert.throws(() => pass(1), /on purpose/);
  pass(1);
  assert.equal(runs, 1);
});

test('the GPU is waited for', (t) => {
  const { scheduler, gpu, pass } = makeWorld(t);
  gpu.milliseconds = 2.5 * TICK;
  let done = 0;
  scheduler.whenDone(() => done++);
  pass(2);
  assert.equal(done, 0);
  pass(1);
  assert.equal(done, 1);
  assert.equal(pass(3), 0);
});

// SPDX-License-Identifier: Apache-2.0
//
// What the direct light of four lamps costs in a scene: `measure` draws it in every way that is compared.
// Before three.js makes a context.
import { since, snapshot } from './gl_memory.js';
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { DirectLight } from '../../web/src/three/direct/direct_light.js';
import { ScreenShares } from '../../web/src/three/direct/screen_shares.js';
import { ShadowMap } from '../../web/src/three/direct/shadow_map.js';
import { DIRECT_KIT } from '../../web/src/three/direct_kit.js';
import { FrameScheduler } from '../../web/src/three/frame_scheduler.js';

const [WIDTH, HEIGHT] = [1280, 720];
/** Pairs of frames that are compared. */
const PAIRS = 9;
/** Points of each lamp that are timed one by one, and until which frames are timed as the page has them. */
const SAMPLES = 6;
const FRAMES_UNTIL = 16;
/** Of the GPU's time in a frame, milliseconds: samples come as fast as they can. */
const ALL_TIME = 10_000;
/** Texels of three.js's shadow maps, of spots and of suns. */
const MAPS = { spot: 1024, sun: 2048 };
/** A fourth of the points: what is measured of each is the same. */
Object.defineProperty(navigator, 'connection', { value: { saveData: true }, configurable: true });

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(WIDTH, HEIGHT, false);
renderer.shadowMap.enabled = true;
const gl = renderer.getContext();

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** Waits until the GPU is done with all that was told; Chromium's `finish` does not wait. */
function wait() {
  const [format, type] = [gl.IMPLEMENTATION_COLOR_READ_FORMAT, gl.IMPLEMENTATION_COLOR_READ_TYPE].map((name) => gl.getParameter(name));
  gl.readPixels(0, 0, 1, 1, format, type, type === gl.FLOAT ? new Float32Array(4) : new Uint8Array(4));
}

/** Milliseconds until the GPU is done with what `draw` tells it. */
function timed(draw) {
  wait();
  const start = performance.now();
  draw();
  wait();
  return performance.now() - start;
}

/** The time of each call of a method, while `during` runs. */
async function timesOf(methods, during) {
  const own = methods.map(([of, name]) => of.prototype[name]);
  const times = methods.map(() => []);
  methods.forEach(([of, name], i) => {
    of.prototype[name] = function (...values) {
      times[i].push(timed(() => own[i].apply(this, values)));
    };
  });
  try {
    await during();
  } finally {
    methods.forEach(([of, name], i) => (of.prototype[name] = own[i]));
  }
  return times;
}

/** Four of a lamp: rectangles side by side, suns a few degrees from one another. */
function fourOf(lamp) {
  return [[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([s, t]) => {
    if (lamp.kind === 'sun') return { ...lamp, normal: new THREE.Vector3(...lamp.normal).add(new THREE.Vector3(0.1 * s, 0, 0.1 * t)).normalize().toArray() };
    return { ...lamp, center: lamp.center.map((c, i) => c + 1.1 * (s * lamp.u[i] + t * lamp.v[i])) };
  });
}

/** Lights of three.js in the places of lamps, with shadow maps. */
function plainLights(lamps, bounds) {
  return lamps.flatMap(({ kind, center, normal }) => {
    const sun = kind === 'sun';
    const light = sun ? new THREE.DirectionalLight(0xffffff, 1) : new THREE.SpotLight(0xffffff, 10, 0, Math.atan(2));
    const { radius, center: middle } = bounds.getBoundingSphere(new THREE.Sphere());
    const place = sun ? middle.clone().addScaledVector(new THREE.Vector3(...normal), -2 * radius) : new THREE.Vector3(...center);
    light.position.copy(place);
    light.target.position.copy(place).add(new THREE.Vector3(...normal));
    light.castShadow = true;
    light.shadow.mapSize.setScalar(MAPS[sun ? 'sun' : 'spot']);
    Object.assign(light.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1, far: 4 * radius });
    light.shadow.camera.updateProjectionMatrix();
    return [light, light.target];
  });
}

async function load(url) {
  const { scene, cameras } = await new GLTFLoader().loadAsync(url);
  const removed = [];
  scene.traverse((object) => {
    if (object.isMesh) object.castShadow = object.receiveShadow = true;
    // Bulbs and suns of the file itself are what lamps stand for.
    if (object.isLight || object.name === 'lamp') removed.push(object);
  });
  for (const object of removed) object.removeFromParent();
  const world = new THREE.Scene().add(scene);
  world.updateMatrixWorld();
  const camera = new THREE.PerspectiveCamera(60, WIDTH / HEIGHT, 0.05, 100);
  cameras[0].matrixWorld.decompose(camera.position, camera.quaternion, camera.scale);
  camera.updateMatrixWorld();
  return { world, camera, bounds: new THREE.Box3().setFromObject(scene) };
}

/** Each of the browser's frames, by when the GPU is done with it, while `during` runs. */
async function framesWhile(during) {
  const times = [];
  const own = globalThis.requestAnimationFrame;
  globalThis.requestAnimationFrame = (callback) => own((time) => times.push(timed(() => callback(time))));
  await during();
  globalThis.requestAnimationFrame = own;
  return times;
}

/** A scene with lamps of Lightwell's, drawn as the page draws it: when there is a better picture. */
function litBy(lamps, { world, camera, bounds }) {
  const scheduler = FrameScheduler.of(renderer);
  const draw = () => renderer.render(world, camera);
  const task = scheduler.add(draw);
  const opening = { gltf: { scene: new THREE.Group() }, meshesOf: () => [] };
  const changed = () => task.requestNow();
  const direct = new DirectLight(DIRECT_KIT, lamps, { renderer, scheduler, bounds, focus: bounds, opening, environment: undefined, grids: [], changed });
  return { direct, draw, objects: [direct.hook, direct.carrier, ...direct.lamps] };
}

const pause = () => new Promise((resolve) => setTimeout(resolve, 50));

async function reach(direct, samples) {
  while (direct.samples < samples) await pause();
  // The last picture, too.
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
}

/** Milliseconds of a sample's map and of its lookup, and triangles of it. */
async function timeSamples(direct, draw) {
  renderer.info.autoReset = false;
  let triangles = 0;
  const [maps, lookups] = await timesOf([[ShadowMap, 'draw'], [ScreenShares, 'add']], async () => {
    direct.setShadows('soft', ALL_TIME);
    draw();
    renderer.info.reset();
    await reach(direct, SAMPLES);
    direct.pause();
    ({ triangles } = renderer.info.render);
  });
  renderer.info.autoReset = true;
  // The first maps are those that are kept, of the lamps' middles.
  const kept = direct.lamps.length;
  return { map: median(maps.slice(kept)), lookup: median(lookups.slice(kept)), triangles: triangles / (maps.length - kept) };
}

/** Medians of two ways to draw, in turn, and of their ratio. */
function compare(first, second) {
  const pairs = Array.from({ length: PAIRS }, () => [first(), second()]);
  return { first: median(pairs.map(([a]) => a)), longest: Math.max(...pairs.map(([a]) => a)), second: median(pairs.map(([, b]) => b)), ratio: median(pairs.map(([a, b]) => a / b)) };
}

globalThis.measure = async (url, lamp) => {
  const stage = await load(url);
  const { world, camera } = stage;
  const lamps = fourOf(lamp);
  const lights = plainLights(lamps, stage.bounds);
  world.add(...lights);
  // Their maps are kept, too.
  renderer.shadowMap.autoUpdate = false;
  renderer.shadowMap.needsUpdate = true;
  renderer.render(world, camera);
  world.remove(...lights);
  const before = snapshot();
  const { direct, draw, objects } = litBy(lamps, stage);
  world.add(...objects);
  draw();
  const sample = await timeSamples(direct, draw);
  const refining = since(before);

  // As the page takes them, a few milliseconds of a frame.
  direct.setShadows('soft');
  draw();
  const frames = await framesWhile(async () => {
    direct.resume();
    await reach(direct, FRAMES_UNTIL);
  });
  direct.setShadows('soft', ALL_TIME);
  draw();
  await reach(direct, Infinity);
  const rest = since(before);

  const shown = (own) => {
    world.remove(...objects, ...lights);
    world.add(...(own ? objects : lights));
    draw();
    return timed(draw);
  };
  const atRest = compare(() => shown(true), () => shown(false));
  shown(true);
  // A step aside from a view at rest, and another one.
  const step = () => {
    camera.position.x += 0.001;
    camera.updateMatrixWorld();
    return timed(draw);
  };
  const [fromRest, moving] = [step(), median(Array.from({ length: PAIRS }, step))];
  direct.dispose();
  return { sample, refining, rest, worst: Math.max(...frames), atRest, fromRest, moving };
};

// SPDX-License-Identifier: Apache-2.0
//
// peer_three.mjs SHARED [NODES [SCENE...]]: three.js's own baked light grid beside Lightwell's, in rooms of SHARED/truth. That grid,
// `LightProbeGridWebGL`, has NODES (16) nodes an axis and is given what it lacks: direct light, by the path tracer, as a light
// map; cube maps of 16 texels; all bounces. Of each: root mean square error and bias in percent in free space and on surfaces,
// core-seconds of the bake, bytes on the wire.
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { BIN } from '../tests/e2e/packs.mjs';
import { bakeInChromium } from './peer_three/chromium.mjs';
import { bytesOnTheWire, irradianceAt, limitOf } from './peer_three/grid.mjs';
import { layOut } from './peer_three/light_map.mjs';
import { readTriangles } from './peer_three/scene.mjs';

const SCENES = ['a_cornell', 'b_tworooms', 'd_blob'];
/** Half of the light that is missing comes with each or more; what nine leave is extrapolated. */
const PASSES = 9;
/**
 * A node draws the scene six times a pass: all 20,480 triangles of the blob would take hours, and change surfaces by 0.5 %. Of a
 * scene with more than so many the coarsest level is drawn.
 */
const MOST_TRIANGLES = 3000;
/** Paths a texel of the light map; a node sees hundreds of texels. */
const SAMPLES = 128;
const HEADER = 'x,y,z,nx,ny,nz,r,g,b';

/** Runs lightwell: what it prints, and for how many seconds it kept processors busy. */
function lightwell(...options) {
  const command = ['-c', 'TIMEFORMAT="%U %S"; time "$@"', 'bash', `${BIN}/lightwell`, ...options, '--quiet'];
  const { status, stdout, stderr } = spawnSync('bash', command, { encoding: 'utf8', maxBuffer: 1 << 28 });
  if (status !== 0) throw new Error(stderr);
  const [user, system] = stderr.trim().split('\n').at(-1).split(' ').map(Number);
  return { stdout, seconds: user + system };
}

const readRows = (csv) => csv.trim().split('\n').slice(1).map((row) => row.split(',').map(Number));
const toCsv = (rows) => [HEADER, ...rows.map((row) => row.join(','))].join('\n') + '\n';
const written = (number) => number.toLocaleString('en');

/** Prints a row of the table; `valuesAt` makes a CSV with light of one with points. */
function printRow(scene, name, valuesAt, seconds, bytes) {
  const errors = ['free', 'surf'].map((kind) => {
    const points = `${shared}/truth/${scene}.${kind}.indirect.csv`;
    const values = join(folder, 'values.csv');
    writeFileSync(values, valuesAt(points));
    const { rms, bias } = JSON.parse(execFileSync('python3', [`${shared}/tools/compare_truth.py`, points, values, '--json']));
    return `${(100 * rms).toFixed(1)} / ${(100 * bias).toFixed(1)}`;
  });
  console.log(`| ${[scene, name, ...errors, seconds.toFixed(0), bytes].join(' | ')} |`);
}

/** Bakes a pack; returns how many triangles it has. */
function bakeWithLightwell(scene, pack, ...options) {
  const { stdout, seconds } = lightwell('bake', `${shared}/truth/${scene}.glb`, '-o', pack, '--json', ...options);
  const { triangles, bytes } = JSON.parse(stdout);
  const valuesAt = (points) => lightwell('probe', pack, '--points', points, '--integrator', 'ivg').stdout;
  printRow(scene, ['Lightwell', ...options].join(' '), valuesAt, seconds, written(bytes.light));
  return triangles;
}

/** A scene as page.js takes it, with its direct light. */
async function litScene(file, nodes) {
  const { lit, lamps, bounds } = await readTriangles(file);
  const { width, height, coordinates, texels } = layOut(lit.position, lit.normal, bounds);
  const points = join(folder, 'texels.csv');
  writeFileSync(points, toCsv(texels.map(({ position, normal }) => [...position, ...normal, 0, 0, 0])));
  const options = ['--integrator', 'path', '--quantity', 'direct', '--spp', String(SAMPLES)];
  const light = readRows(lightwell('probe', file, '--points', points, ...options).stdout);
  const map = new Float32Array(4 * width * height);
  for (const [i, { x, y }] of texels.entries()) map.set(light[i].slice(6, 9), 4 * (x + width * y));
  return { lit: { ...lit, uv: coordinates }, lamps, lightMap: { width, height, texels: map }, bounds, nodes };
}

async function bakeWithThree(scene, file, nodes) {
  const given = await litScene(file, nodes);
  const { grids, seconds } = await bakeInChromium(given, PASSES);
  const grid = limitOf(grids);
  const withLight = (row) => [...row.slice(0, 6), ...irradianceAt(grid, nodes, given.bounds, row.slice(0, 3), row.slice(3, 6))];
  const valuesAt = (points) => toCsv(readRows(readFileSync(points, 'utf8')).map(withLight));
  const { json, floats } = bytesOnTheWire(grid, nodes, given.bounds);
  printRow(scene, `three.js, ${nodes}³ nodes`, valuesAt, seconds, `${written(json)} (floats: ${written(floats)})`);
}

const [shared, nodes = '16', ...scenes] = process.argv.slice(2);
if (shared === undefined) throw new Error('usage: node bench/peer_three.mjs SHARED [NODES [SCENE...]]');
const folder = mkdtempSync(join(tmpdir(), 'lightwell-peer-'));
console.log('| scene | baked by | free points | on surfaces | core-seconds | bytes |');
console.log('|---|---|---|---|---|---|');
try {
  for (const scene of scenes.length > 0 ? scenes : SCENES) {
    const [pack, coarse] = ['pack.lw.glb', 'coarse.glb'].map((name) => join(folder, name));
    bakeWithLightwell(scene, pack, '--grid', '32');
    bakeWithLightwell(scene, pack, '--budget', '64k');
    const triangles = bakeWithLightwell(scene, pack);
    const isFine = triangles > MOST_TRIANGLES;
    if (isFine) lightwell('export', pack, '-o', coarse, '--level', '0');
    await bakeWithThree(scene, isFine ? coarse : `${shared}/truth/${scene}.glb`, Number(nodes));
  }
} finally {
  rmSync(folder, { recursive: true });
}

// SPDX-License-Identifier: Apache-2.0
//
// direct_cost.mjs SCENE...: what the page's direct light of four lamps costs at 1280 x 720, by times until the GPU is done, all in frames of the
// same scene at rest; the memory that its textures take, by what WebGL is told. SCENE is a built-in one or a file; its first lamp is four.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { launch, openPage } from '../tests/e2e/browser.mjs';
import { bake, BIN } from '../tests/e2e/packs.mjs';
import { startStaticServer } from '../tests/e2e/static_server.mjs';
import { scriptPage } from '../tests/e2e/test_page.mjs';

/** Hundreds of frames of a second each in software; milliseconds. */
const PATIENCE = 1_800_000;
const MEGABYTE = 1e6;

const rounded = (x) => x.toFixed(2);

/** Measures a scene in a page of its own, whose context and textures no other has. */
async function measure(scene, script) {
  const [pack, plain] = ['pack.lw.glb', 'plain.glb'].map((name) => join(folder, name));
  bake(scene, pack, { photons: 20_000, grid: 4 });
  const file = readFileSync(pack);
  const [lamp] = JSON.parse(file.subarray(20, 20 + file.readUInt32LE(12))).extensions.LIGHTWELL_lamps.lamps;
  execFileSync(`${BIN}/lightwell`, ['export', pack, '-o', plain, '--quiet']);
  const server = await startStaticServer({ ...script, '/scene.glb': plain });
  const { page, errors, close } = await openPage(browser);
  page.setDefaultTimeout(PATIENCE);
  try {
    await page.goto(server.url);
    await page.waitForFunction(() => globalThis.measure);
    const figures = await page.evaluate((of) => globalThis.measure('scene.glb', of), lamp);
    if (errors.length > 0) throw new Error(errors.join('\n'));
    return { name: `${basename(scene, '.glb')}, four of its ${lamp.kind}`, ...figures };
  } finally {
    await close();
    await server.close();
  }
}

function timeRow({ name, sample, worst, atRest, fromRest, moving }) {
  const { first: frame, second: plain, ratio } = atRest;
  const one = sample.map + sample.lookup;
  const cells = [name, `${rounded(one / frame)} (${rounded(sample.map / frame)} + ${rounded(sample.lookup / frame)})`];
  cells.push(rounded(one / plain), sample.triangles.toFixed(0), rounded(worst / atRest.longest), rounded(ratio), rounded(moving / frame), rounded(fromRest / moving));
  return `| ${cells.join(' | ')} |`;
}

/** Textures of a kind while refining, and those of them that are there at rest, in megabytes. */
function memoryRows({ refining, rest }) {
  const megabytes = (rows) => rows.reduce((sum, { bytes }) => sum + bytes, 0) / MEGABYTE;
  const rows = refining.map(({ what, count, bytes }) => {
    const left = rest.filter((row) => row.what === what);
    return `| ${count} of ${what} | ${(bytes / MEGABYTE).toFixed(1)} | ${megabytes(left).toFixed(1)} |`;
  });
  return [...rows, `| all | ${megabytes(refining).toFixed(1)} | ${megabytes(rest).toFixed(1)} |`];
}

const scenes = process.argv.slice(2);
if (scenes.length === 0) throw new Error('usage: node bench/direct_cost.mjs SCENE...');
const folder = mkdtempSync(join(tmpdir(), 'lightwell-cost-'));
const browser = await launch();
try {
  const script = await scriptPage('bench/direct_cost/page.js');
  const all = [];
  console.log('| scene | a sample (map + lookup) | in frames of four plain lights | its triangles | worst frame / worst at rest | at rest / four plain lights | moving | first one from rest / moving |');
  console.log('|---|---|---|---|---|---|---|---|');
  for (const scene of scenes) {
    all.push(await measure(scene, script));
    console.log(timeRow(all.at(-1)));
  }
  console.log(['', `| ${all[0].name}: textures | refining, MB | at rest, MB |`, '|---|---|---|', ...memoryRows(all[0])].join('\n'));
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}

// SPDX-License-Identifier: Apache-2.0
//
// The content security policies of docs/hosting.md: what they are for works under them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { ROOT } from './dependencies.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage, viewerPage } from './test_page.mjs';
import { complete } from './view.mjs';

const hosting = readFileSync(`${ROOT}docs/hosting.md`, 'utf8');
const [OWN, ELSEWHERE] = [...hosting.matchAll(/^Content-Security-Policy: (.+)$/gm)].map(([, policy]) => policy);
/** A pixel brighter than this, of 255, is lit. */
const LIT = 40;

const folder = temporaryFolder();
const PACK = writeSamplePack(`${folder}/pack.lw.glb`, 5_000);
/** Runs in the page before its scripts: `violations` collects what the browser refuses. */
const COLLECT = `globalThis.violations = [];
addEventListener('securitypolicyviolation', (event) => violations.push(event.violatedDirective + ' ' + event.blockedURI));`;

const browser = await forAllTests(launch());

/** The pack is complete, a worker has decoded it, the picture fills its box and is lit, and nothing was refused. */
async function assertWorks(t, url) {
  const { page, errors } = await forTest(t, openPage(browser, { init: COLLECT }));
  await page.goto(url);
  await complete(page);
  assert.equal(page.workers().length, 1);
  const { canvas, box, brightest } = await page.evaluate(() => {
    const view = document.querySelector('lightwell-view');
    const canvas = view.shadowRoot.querySelector('canvas');
    view.draw();
    const { width, height } = canvas;
    const picture = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
    picture.drawImage(canvas, 0, 0);
    const size = ({ clientWidth, clientHeight }) => [clientWidth, clientHeight];
    return { canvas: size(canvas), box: size(view), brightest: Math.max(...picture.getImageData(0, 0, width, height).data.filter((_, i) => i % 4 === 1)) };
  });
  assert.deepEqual(canvas, box);
  assert.ok(brightest > LIT, `the picture is dark: ${brightest}`);
  assert.deepEqual(await page.evaluate(() => globalThis.violations), []);
  assert.deepEqual(errors, []);
}

test('the page, everything on one server', async (t) => {
  const headers = { 'Content-Security-Policy': OWN };
  await assertWorks(t, (await forTest(t, startStaticServer({ ...viewerPage('/pack.lw.glb'), '/pack.lw.glb': PACK }, { headers }))).url);
});

test('the element, script and pack on another server', async (t) => {
  const other = await forTest(t, startStaticServer({ ...(await elementPage('')), '/pack.lw.glb': PACK }));
  const page = await elementPage(`<lightwell-view src="${other.url}pack.lw.glb">`, `${other.url}script.js`);
  const headers = { 'Content-Security-Policy': ELSEWHERE.replaceAll('https://cdn.example', other.url.slice(0, -1)) };
  await assertWorks(t, (await forTest(t, startStaticServer({ '/': page['/'] }, { headers }))).url);
});

test('without a worker the page decodes by itself', async (t) => {
  const headers = { 'Content-Security-Policy': OWN.replace("worker-src 'self'", "worker-src 'none'") };
  const server = await forTest(t, startStaticServer({ ...viewerPage('/pack.lw.glb'), '/pack.lw.glb': PACK }, { headers }));
  const { page } = await forTest(t, openPage(browser));
  await page.goto(server.url);
  await complete(page);
  assert.equal(page.workers().length, 0);
});

// SPDX-License-Identifier: Apache-2.0
//
// What an element says in its own box: how much has come, and what went wrong.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { forAllTests, forTest } from './lifetime.mjs';
import { temporaryFolder, writeSamplePack } from './packs.mjs';
import { startSlowRelay } from './slow_relay.mjs';
import { startStaticServer } from './static_server.mjs';
import { elementPage } from './test_page.mjs';
import { complete } from './view.mjs';

/** Bytes a second of each response: the bar is there for a while. */
const SLOW = 100_000;

const folder = temporaryFolder();
writeSamplePack(`${folder}/room.lw.glb`, 50_000);
writeUnbaked(`${folder}/unbaked.glb`);

const browser = await forAllTests(launch());

/** A glTF binary as a modelling program writes it. */
function writeUnbaked(file) {
  const json = Buffer.from(JSON.stringify({ asset: { version: '2.0' }, scenes: [{ nodes: [] }], scene: 0 }).padEnd(80));
  const head = Buffer.alloc(20);
  head.write('glTF');
  [2, 20 + json.length, json.length].forEach((number, i) => head.writeUInt32LE(number, 4 + 4 * i));
  head.write('JSON', 16);
  writeFileSync(file, Buffer.concat([head, json]));
}

async function openElement(t, body, slowly = false) {
  let server = await forTest(t, startStaticServer({ ...(await elementPage(body)), '/room.lw.glb': `${folder}/room.lw.glb`, '/unbaked.glb': `${folder}/unbaked.glb` }));
  if (slowly) server = await forTest(t, startSlowRelay(server.url, SLOW));
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url);
  return opened;
}

/** The text that the element's box shows; only what can be seen counts. */
const text = (page, pattern) => page.getByText(new RegExp(pattern)).filter({ visible: true });

for (const [what, src, message] of [
  ['an unbaked GLB', 'unbaked.glb', 'unbaked\\.glb: is no pack; `lightwell bake` makes one'],
  ['a page in its place', './', '/: is HTML or XML'],
  ['a file that is not there', 'none.glb', 'none\\.glb: the server answers 404'],
])
  test(`${what} is said in the box and in one line of the console`, async (t) => {
    const { page, errors } = await openElement(t, `<lightwell-view src="${src}"></lightwell-view>`);
    await text(page, message).waitFor();
    assert.equal(errors.length, 1, `${errors}`);
    assert.match(errors[0], new RegExp(`^lightwell-view: .*${message}$`));
    assert.equal(await page.getByRole('progressbar').filter({ visible: true }).count(), 0);
    const box = await page.locator('lightwell-view').boundingBox();
    const said = await text(page, message).boundingBox();
    assert.ok(said.y >= box.y && said.y + said.height <= box.y + box.height, 'the words leave the box');
  });

test('words of the page’s own take the place of the message, and are hidden until then', async (t) => {
  const { page } = await openElement(t, '<lightwell-view><p slot="error">Come again tomorrow.</p></lightwell-view>');
  const own = text(page, 'tomorrow');
  await page.waitForFunction(() => document.querySelector('lightwell-view').shadowRoot);
  assert.equal(await own.count(), 0);
  await page.evaluate(() => document.querySelector('lightwell-view').setAttribute('src', 'unbaked.glb'));
  await own.waitFor();
  assert.equal(await text(page, 'lightwell bake').count(), 0);
});

test('the message goes when another pack is shown', async (t) => {
  const { page } = await openElement(t, '<lightwell-view src="unbaked.glb"></lightwell-view>');
  await text(page, 'is no pack').waitFor();
  await page.evaluate(() => document.querySelector('lightwell-view').setAttribute('src', 'room.lw.glb'));
  await complete(page);
  assert.equal(await text(page, 'is no pack').count(), 0);
});

test('a bar tells how much has come, and goes when that is all', async (t) => {
  const { page, errors } = await openElement(t, '<lightwell-view src="room.lw.glb"></lightwell-view>', true);
  const bar = page.getByRole('progressbar').filter({ visible: true });
  await bar.waitFor();
  await page.waitForFunction(() => document.querySelector('lightwell-view').progress?.bytes.done > 0);
  const percent = Number(await bar.getAttribute('aria-valuenow'));
  assert.ok(percent > 0 && percent <= 100, `${percent} %`);
  await complete(page);
  assert.equal(await bar.count(), 0);
  assert.deepEqual(errors, []);
});

test('a bar of the page’s own takes the place of the element’s', async (t) => {
  const { page } = await openElement(t, '<lightwell-view src="room.lw.glb"><b slot="progress">Wait</b></lightwell-view>', true);
  await text(page, 'Wait').waitFor();
  assert.equal(await page.getByRole('progressbar').filter({ visible: true }).count(), 0);
  await complete(page);
  assert.equal(await text(page, 'Wait').count(), 0);
});

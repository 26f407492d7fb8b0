// SPDX-License-Identifier: Apache-2.0
import { textPlugins } from '../../web/text_plugins.mjs';
import { openPage } from './browser.mjs';
import { build, ROOT, WEB } from './dependencies.mjs';
import { forTest } from './lifetime.mjs';
import { startStaticServer } from './static_server.mjs';

/** Routes of Lightwell's own page with the pack of a URL. */
export function viewerPage(url) {
  const packs = [{ name: url.split('/').at(-1), url }];
  return { '/': `${WEB}dist`, '/packs.json': { text: JSON.stringify({ packs }), type: 'application/json' } };
}

/** Routes of what a script that shows packs loads by itself. */
export const CLIENT = { '/worker.js': `${WEB}dist/worker.js`, '/lightwell.wasm': `${WEB}dist/lightwell.wasm` };

/** Bundles a script of tests/e2e/pages/ or web/examples/, with three.js; gives its text. */
export async function bundle(path) {
  const result = await build({
    entryPoints: [`${ROOT}${path}`],
    bundle: true,
    format: 'esm',
    target: 'es2022',
    write: false,
    nodePaths: [`${WEB}node_modules`],
    alias: { 'lightwell/three': `${WEB}src/three/index.ts` },
    plugins: textPlugins,
  });
  return result.outputFiles[0].text;
}

/** Routes of a page at / that runs a bundled script. */
export async function scriptPage(path) {
  const html = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="module" src="script.js"></script>`;
  return {
    '/': { text: html, type: 'text/html' },
    '/script.js': { text: await bundle(path), type: 'text/javascript' },
  };
}

/** Opens, for one test, a page that runs a bundled script and finds Lightwell's client; `routes` are more of them. */
export async function openScript(t, browser, path, { query = '', ...routes } = {}) {
  const server = await forTest(t, startStaticServer({ ...(await scriptPage(path)), ...CLIENT, ...routes }));
  const opened = await forTest(t, openPage(browser));
  await opened.page.goto(server.url + query);
  return opened;
}

/** Routes of a page at / whose body has <lightwell-view> in it; `script` is where its script lies. */
export async function elementPage(body, script = 'script.js') {
  const routes = await scriptPage('tests/e2e/pages/element.ts');
  const html = `<!doctype html><meta charset="utf-8"><meta name="viewport" content="width=device-width">
    <script type="module" src="${script}"></script><body>${body}`;
  return { ...routes, ...CLIENT, '/': { text: html, type: 'text/html' } };
}

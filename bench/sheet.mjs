// SPDX-License-Identifier: Apache-2.0
//
// Pictures side by side, for the eye. A page of the browser draws them.
import { readFileSync, writeFileSync } from 'node:fs';
import { extname } from 'node:path';

/** Of JPEGs: small files in which edges are still clean. */
const QUALITY = 0.85;

/** Runs in the page. */
async function loadPicture(url) {
  const image = new Image();
  image.src = url;
  await image.decode();
  return image;
}

/** Runs in the page. */
function pixelsOf(image) {
  const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, image.width, image.height);
}

/** Runs in the page: draws cells of { label, url, minus }, a picture or by how much two differ; gives the sheet's address. */
async function drawSheet({ cells, gain, type, quality }) {
  const GAP = 2;
  const pictures = await Promise.all(cells.map(({ url }) => loadPicture(url)));
  const { width, height } = pictures[0];
  const canvas = Object.assign(document.createElement('canvas'), { width: cells.length * (width + GAP) - GAP, height });
  const context = canvas.getContext('2d');
  context.fillStyle = 'white';
  context.fillRect(0, 0, canvas.width, height);
  context.font = '11px sans-serif';
  for (const [i, { label, minus }] of cells.entries()) {
    const x = i * (width + GAP);
    context.fillStyle = 'black';
    context.fillRect(x, 0, width, height);
    context.drawImage(pictures[i], x, 0);
    if (minus !== undefined) {
      const shown = pixelsOf(pictures[i]);
      const { data } = pixelsOf(await loadPicture(minus));
      shown.data.forEach((value, k) => (shown.data[k] = k % 4 === 3 ? 255 : gain * Math.abs(value - data[k])));
      context.putImageData(shown, x, 0);
    }
    context.fillRect(x, 0, context.measureText(label).width + 6, 15);
    context.fillStyle = 'white';
    context.fillText(label, x + 3, 11);
  }
  return canvas.toDataURL(type, quality);
}

/** Runs in the page: one picture before the colour that another one has where the first shows nothing at all. */
async function drawBefore([front, behind]) {
  const [picture, other] = await Promise.all([loadPicture(front), loadPicture(behind)]);
  const empty = pixelsOf(picture).data.findIndex((value, i) => i % 4 === 3 && value === 0);
  if (empty < 0) return front;
  const { width, height } = picture;
  const canvas = Object.assign(document.createElement('canvas'), { width, height });
  const context = canvas.getContext('2d');
  context.fillStyle = `rgb(${pixelsOf(other).data.slice(empty - 3, empty).join()})`;
  context.fillRect(0, 0, width, height);
  context.drawImage(picture, 0, 0);
  return canvas.toDataURL();
}

async function draw(browser, file, drawing, values) {
  const page = await browser.newPage();
  await page.addScriptTag({ content: `${loadPicture}\n${pixelsOf}` });
  const url = await page.evaluate(drawing, values);
  await page.close();
  writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
}

const address = (file) => `data:image/png;base64,${readFileSync(file).toString('base64')}`;

/**
 * Writes a sheet, .png or .jpg, of cells of { label, picture, minus }: a PNG file, or where `minus` is another one by how much they
 * differ, `gain` times. All pictures have one size.
 */
export async function writeSheet(browser, file, cells, gain = 1) {
  const pictures = cells.map(({ label, picture, minus }) => ({ label, url: address(picture), minus: minus && address(minus) }));
  const type = extname(file) === '.jpg' ? 'image/jpeg' : 'image/png';
  await draw(browser, file, drawSheet, { cells: pictures, gain, type, quality: QUALITY });
}

/** The page shows its own background where `render` shows the sky: puts the colour of a uniform sky, as `rendered` has it, behind `picture`. */
export const putBeforeSky = (browser, picture, rendered) => draw(browser, picture, drawBefore, [address(picture), address(rendered)]);

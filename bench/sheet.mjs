// SPDX-License-Identifier: Apache-2.0
//
// Pictures side by side, for the eye.
import { readFileSync, writeFileSync } from 'node:fs';
import { extname } from 'node:path';

/** Of JPEGs: small files in which edges are still clean. */
const QUALITY = 0.85;

/** Runs in a page: draws cells of { label, url, minus }, a picture or by how much two differ, so many a row; gives the sheet's address. */
async function drawSheet({ cells, columns, gain, type, quality }) {
  const GAP = 2;
  const load = async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    return image;
  };
  const pixelsOf = ({ width, height }, ...images) => {
    const context = new OffscreenCanvas(width, height).getContext('2d');
    return images.map((image) => {
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, width, height);
    });
  };
  const pictures = await Promise.all(cells.map(({ url }) => load(url)));
  const { width, height } = pictures[0];
  const canvas = document.createElement('canvas');
  canvas.width = columns * (width + GAP) - GAP;
  canvas.height = Math.ceil(cells.length / columns) * (height + GAP) - GAP;
  const context = canvas.getContext('2d');
  context.fillStyle = 'white';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.font = '11px sans-serif';
  for (const [i, { label, minus }] of cells.entries()) {
    const [x, y] = [(i % columns) * (width + GAP), Math.floor(i / columns) * (height + GAP)];
    context.drawImage(pictures[i], x, y);
    if (minus !== undefined) {
      const [shown, other] = pixelsOf(pictures[i], pictures[i], await load(minus));
      for (let k = 0; k < shown.data.length; k++) shown.data[k] = k % 4 === 3 ? 255 : gain * Math.abs(shown.data[k] - other.data[k]);
      context.putImageData(shown, x, y);
    }
    context.fillStyle = 'black';
    context.fillRect(x, y, context.measureText(label).width + 6, 15);
    context.fillStyle = 'white';
    context.fillText(label, x + 3, y + 11);
  }
  return canvas.toDataURL(type, quality);
}

/** Runs in a page: one picture before the colour that another one has where the first shows nothing at all. */
async function drawBefore([front, behind]) {
  const load = async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    return image;
  };
  const [picture, other] = await Promise.all([load(front), load(behind)]);
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [picture.width, picture.height];
  const context = canvas.getContext('2d');
  const pixelsOf = (image) => {
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const empty = pixelsOf(picture).findIndex((value, i) => i % 4 === 3 && value === 0);
  if (empty < 0) return front;
  const sky = pixelsOf(other).slice(empty - 3, empty);
  context.fillStyle = `rgb(${sky.join()})`;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(picture, 0, 0);
  return canvas.toDataURL();
}

const address = (file) => `data:image/png;base64,${readFileSync(file).toString('base64')}`;

/**
 * Writes a sheet, .png or .jpg, of cells of { label, picture, minus }: a PNG file, or where `minus` is another one by how much they
 * differ, `gain` times. All pictures have one size; `columns` stand in a row.
 */
export async function writeSheet(browser, file, cells, { columns = cells.length, gain = 4 } = {}) {
  const pictures = cells.map(({ label, picture, minus }) => ({ label, url: address(picture), minus: minus && address(minus) }));
  const type = extname(file) === '.jpg' ? 'image/jpeg' : 'image/png';
  await draw(browser, file, drawSheet, { cells: pictures, columns, gain, type, quality: QUALITY });
}

/** The page shows its own background where `render` shows the sky: puts the colour of a uniform sky, as `rendered` has it, behind `picture`. */
export const putBeforeSky = (browser, picture, rendered) => draw(browser, picture, drawBefore, [address(picture), address(rendered)]);

async function draw(browser, file, drawing, values) {
  const page = await browser.newPage();
  const url = await page.evaluate(drawing, values);
  await page.close();
  writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
}

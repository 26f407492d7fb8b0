// SPDX-License-Identifier: Apache-2.0

/** Moves of a finger on its way. */
const STEPS = 10;

/** What moves fingers on a page of a size: each goes from one place to another, as parts of the screen. */
export async function openFingers(page, { width, height }) {
  const session = await page.context().newCDPSession(page);
  const touch = (type, fingers) =>
    session.send('Input.dispatchTouchEvent', { type, touchPoints: fingers.map(([x, y], id) => ({ x: x * width, y: y * height, id })) });
  return {
    put: (place) => touch('touchStart', [place]),
    drag: (place) => touch('touchMove', [place]),
    lift: () => touch('touchEnd', []),
    async move(...ways) {
      const at = (step) => ways.map(({ from, to }) => from.map((start, axis) => start + ((to[axis] - start) * step) / STEPS));
      await touch('touchStart', at(0));
      for (let step = 1; step <= STEPS; step++) await touch('touchMove', at(step));
      await touch('touchEnd', []);
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';
import type { View } from '../element/orbit.js';

/** What the URL's fragment says: #pack=NAME&view=theta,phi,radius,x,y,z */
export interface Hash {
  pack: string | null;
  /** Shows another pack from now on, with its own first view. */
  setPack(name: string): void;
}

/** Keeps the camera in the URL, so that a link shows what the sender saw. */
export function bindHash(view: LightwellView): Hash {
  const parameters = new URLSearchParams(location.hash.slice(1));
  const wanted = parseView(parameters.get('view'));
  if (wanted !== null) view.view = wanted;
  let pack = parameters.get('pack');
  const write = (camera: View | null) => history.replaceState(null, '', `#${fragment(pack, camera)}`);
  view.on('camera-change', write);
  return {
    pack,
    setPack(name) {
      pack = name;
      write(null);
    },
  };
}

function fragment(pack: string | null, view: View | null): string {
  const parts = pack === null ? [] : [`pack=${encodeURIComponent(pack)}`];
  if (view !== null) {
    const numbers = [view.theta, view.phi, view.radius, ...view.target].map((number) => Number(number.toFixed(4)));
    parts.push(`view=${numbers.join(',')}`);
  }
  return parts.join('&');
}

function parseView(text: string | null): View | null {
  const numbers = text?.split(',').map(Number) ?? [];
  if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return null;
  const [theta, phi, radius, x, y, z] = numbers as [number, number, number, number, number, number];
  return { theta, phi, radius, target: [x, y, z] };
}

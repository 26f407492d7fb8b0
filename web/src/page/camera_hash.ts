// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';
import type { View } from '../element/orbit.js';

/** What the URL's fragment says: #pack=NAME&view=theta,phi,radius,x,y,z. Without it ?pack=NAME and &view= are taken. */
export interface Hash {
  /** The pack that it named at first. */
  readonly wanted: string | null;
  /** The view of that pack that it named at first. */
  readonly view: View | null;
  /** Names the pack that is shown from now on, in the given view or else in its own. */
  setPack(name: string, view: View | null): void;
}

/** Keeps pack and camera in the URL, so that a link shows what the sender saw. A URL that the user changes is loaded. */
export function bindHash(element: LightwellView): Hash {
  const parameters = new URLSearchParams(location.hash.slice(1) || location.search);
  let pack = '';
  let written = location.href;
  const write = (camera: View | null) => {
    // What the user has typed since stays, though its event is still to come.
    if (location.href !== written) return;
    history.replaceState(null, '', fragment(pack, camera));
    written = location.href;
  };
  element.on('camera-change', write);
  addEventListener('hashchange', () => location.reload());
  return {
    wanted: parameters.get('pack') || null,
    view: parseView(parameters.get('view')),
    setPack(name, view) {
      pack = name;
      if (view !== null) element.view = view;
      write(view);
    },
  };
}

function fragment(pack: string, view: View | null): string {
  const name = `#pack=${encodeURIComponent(pack)}`;
  if (view === null) return name;
  const numbers = [view.theta, view.phi, view.radius, ...view.target].map((number) => Number(number.toFixed(4)));
  return `${name}&view=${numbers}`;
}

function parseView(text: string | null): View | null {
  const numbers = text?.split(',').map(Number) ?? [];
  if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return null;
  const [theta, phi, radius, x, y, z] = numbers as [number, number, number, number, number, number];
  return { theta, phi, radius, target: [x, y, z] };
}

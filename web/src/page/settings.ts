// SPDX-License-Identifier: Apache-2.0
import type { Material, Mesh } from 'three';
import type { LightwellView } from '../element/lightwell_view.js';
import type { LightwellScene } from '../three/scene.js';
import html from './settings.html';
import { bindCameras } from './cameras.js';
import { brickEdges, gridNodes, linkLines, type Three } from './light_cells.js';
import { bindLightGroups } from './light_groups.js';
import { bindSharing } from './sharing.js';

const HOW_TO: Record<string, string> = {
  walk: 'W, A, S, D or arrow keys walk, with shift you run; a drag looks around.',
  measure: 'Click or tap two points.',
  'raking-light': 'Drag the lamp in the upper corner.',
  compare: 'Drag the line: to its left there is no bounced light.',
};
/** Stops to both sides of none, and of the pack's own exposure. */
const LEEWAY = 4;

/**
 * Puts the controls into the panel; most set an attribute of the element. The page fetches this script when the settings are unfolded: it
 * imports nothing that the page has (docs/decisions/008-size-of-the-page.md).
 */
export function bindSettings(view: LightwellView, three: Three): void {
  document.querySelector('#settings')!.insertAdjacentHTML('beforeend', html);
  bindStrategy(view);
  bindLight(view);
  bindExposure(view);
  bindWalk(view);
  bindCells(view, '#light-cells', (pack) => brickEdges(pack, three));
  bindCells(view, '#light-nodes', (pack) => gridNodes(pack, three));
  bindCells(view, '#light-links', async (pack) => (await pack.blockedLinks()).flatMap((ends) => linkLines(ends, three)));
  bindLightGroups(view);
  bindCameras(view);
  bindShadows(view);
  bindSharing(view);
  for (const attribute of ['wireframe', 'measure', 'compare', 'raking-light', 'animation']) bindSwitch(view, attribute);
  showWhereAnimated(view);
}

/** The switch of what moves is there where something does. */
function showWhereAnimated(view: LightwellView): void {
  const switched = document.querySelector('#animation')!.parentElement!;
  const show = () => (switched.hidden = !view.pack?.opening.gltf.animations.length);
  view.on('load', show);
  show();
}

/** A box that is ticked while the element has the attribute of its name. */
function bindSwitch(view: LightwellView, attribute: string): void {
  const box = document.getElementById(attribute) as HTMLInputElement;
  box.addEventListener('change', () => view.toggleAttribute(attribute, box.checked));
  const show = () => {
    box.checked = view.hasAttribute(attribute);
    say((box.checked && HOW_TO[attribute]) || '');
  };
  new MutationObserver(show).observe(view, { attributeFilter: [attribute] });
}

function say(words: string): void {
  document.querySelector<HTMLOutputElement>('#done')!.value = words;
}

/** How far the shadows of lamps have come. */
function bindShadows(view: LightwellView): void {
  const line = document.querySelector<HTMLElement>('#shadows')!;
  const show = () => {
    const { lamps = [], shadowSamples = 0, shadowError = 0 } = view.pack ?? {};
    line.hidden = lamps.length === 0;
    const off = shadowError > 1 ? `error ${shadowError.toFixed(1)} visible steps` : 'no visible error';
    const count = shadowSamples < Infinity ? `${shadowSamples} points` : 'at rest';
    line.querySelector('output')!.value = shadowError < Infinity ? `${count}, ${off}` : count;
  };
  view.on('frame', show);
  show();
}

function bindStrategy(view: LightwellView): void {
  const strategies = document.querySelectorAll<HTMLInputElement>('#strategy input');
  for (const input of strategies) input.addEventListener('change', () => view.setAttribute('strategy', input.value));
}

function bindLight(view: LightwellView): void {
  const direct = document.querySelector<HTMLInputElement>('#direct')!;
  const indirect = document.querySelector<HTMLInputElement>('#indirect')!;
  const apply = () => {
    const lights = ['off', 'direct', 'indirect', 'all'];
    view.setAttribute('light', lights[Number(direct.checked) + 2 * Number(indirect.checked)]!);
  };
  direct.addEventListener('change', apply);
  indirect.addEventListener('change', apply);
}

/** A box that shows something of the pack's grids, as far as they have come. */
function bindCells(view: LightwellView, id: string, meshesOf: (pack: LightwellScene) => Mesh[] | Promise<Mesh[]>): void {
  const box = document.querySelector<HTMLInputElement>(id)!;
  let shown: Mesh[] = [];
  let turn = 0;
  const apply = async () => {
    const own = ++turn;
    const { pack } = view;
    const meshes = box.checked && pack !== null ? await meshesOf(pack) : [];
    if (own !== turn) return;
    for (const mesh of shown) {
      mesh.removeFromParent();
      mesh.geometry.dispose();
      (mesh.material as Material).dispose();
    }
    shown = meshes;
    if (shown.length > 0) pack!.add(...shown);
    view.invalidate();
  };
  box.addEventListener('change', apply);
  view.on('load', apply);
  view.on('complete', apply);
}

function bindWalk(view: LightwellView): void {
  const walk = document.querySelector<HTMLInputElement>('#walk')!;
  walk.addEventListener('change', () => {
    view.setAttribute('camera-controls', walk.checked ? 'walk' : 'always');
    say((walk.checked && HOW_TO['walk']) || '');
    view.shadowRoot!.querySelector('canvas')?.focus();
  });
}

function bindExposure(view: LightwellView): void {
  const slider = document.querySelector<HTMLInputElement>('#exposure')!;
  const stops = document.querySelector<HTMLOutputElement>('#stops')!;
  const label = () => (stops.value = Number(slider.value).toFixed(1));
  const show = () => {
    const exposure = view.pack?.exposure ?? 0;
    slider.min = String(Math.min(-LEEWAY, exposure - LEEWAY));
    slider.max = String(Math.max(LEEWAY, exposure + LEEWAY));
    if (!view.hasAttribute('exposure')) slider.value = String(exposure);
    label();
  };
  view.on('load', show);
  show();
  slider.addEventListener('input', () => {
    view.setAttribute('exposure', slider.value);
    label();
  });
}

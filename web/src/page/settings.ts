// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** The controls of the panel; each sets an attribute of the element. */
export function bindSettings(view: LightwellView): void {
  bindStrategy(view);
  bindLight(view);
  bindExposure(view);
  const wireframe = document.querySelector<HTMLInputElement>('#wireframe')!;
  wireframe.addEventListener('change', () => view.toggleAttribute('wireframe', wireframe.checked));
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

function bindExposure(view: LightwellView): void {
  const slider = document.querySelector<HTMLInputElement>('#exposure')!;
  const stops = document.querySelector<HTMLOutputElement>('#stops')!;
  const label = () => (stops.value = Number(slider.value).toFixed(1));
  view.on('load', () => {
    if (!view.hasAttribute('exposure')) slider.value = String(view.pack!.exposure);
    label();
  });
  slider.addEventListener('input', () => {
    view.setAttribute('exposure', slider.value);
    label();
  });
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

/** A slider for each group of the pack's lamps, from dark to twice as bright. */
export function bindLightGroups(view: LightwellView): void {
  const all = document.querySelector('#groups')!;
  const show = () => all.replaceChildren(...(view.pack?.lightGroups ?? []).map((name) => slider(view, name)));
  view.on('load', show);
  show();
}

function slider(view: LightwellView, name: string): HTMLElement {
  const label = Object.assign(document.createElement('label'), { className: 'slider', title: name });
  label.append(Object.assign(document.createElement('span'), { textContent: name }));
  const input = Object.assign(document.createElement('input'), { type: 'range', min: '0', max: '2', step: '0.05', value: '1' });
  const output = document.createElement('output');
  const apply = () => (output.value = `${Math.round(100 * Number(input.value))}%`);
  apply();
  input.addEventListener('input', () => {
    apply();
    view.setLightGroup(name, Number(input.value));
  });
  label.append(input, output);
  return label;
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

type Factor = [number, number, number];

/** A slider, from dark to twice as bright, and a colour for each group of the pack's lamps; and for the sky's own light where that is apart. */
export function bindLightGroups(view: LightwellView): void {
  const all = document.querySelector('#groups')!;
  const show = () => {
    const { lightGroups = [], skyIsApart = false } = view.pack ?? {};
    const sliders = lightGroups.map((name) => slider(name, (factor) => view.setLightGroup(name, factor)));
    if (skyIsApart) sliders.push(slider('The sky’s own light', (factor) => view.pack?.setSkyLight(factor)));
    all.replaceChildren(...sliders);
  };
  view.on('load', show);
  show();
}

function slider(name: string, change: (factor: Factor) => void): HTMLElement {
  const label = Object.assign(document.createElement('label'), { className: 'slider', title: name });
  label.append(Object.assign(document.createElement('span'), { textContent: name }));
  const strength = Object.assign(document.createElement('input'), { type: 'range', min: '0', max: '2', step: '0.05', value: '1' });
  const output = document.createElement('output');
  const colour = Object.assign(document.createElement('input'), { type: 'color', value: '#ffffff', ariaLabel: `Colour of ${name}` });
  const apply = () => {
    output.value = `${Math.round(100 * Number(strength.value))}%`;
    return linearColour(colour.value).map((channel) => channel * Number(strength.value)) as Factor;
  };
  apply();
  for (const input of [strength, colour]) input.addEventListener('input', () => change(apply()));
  label.append(strength, output, colour);
  return label;
}

/** Of "#rrggbb", which is sRGB. */
function linearColour(hex: string): Factor {
  const channels = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  return channels.map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4)) as Factor;
}

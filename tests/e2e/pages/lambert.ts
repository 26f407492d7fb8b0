// SPDX-License-Identifier: Apache-2.0
//
// A pack in a <lightwell-view> whose materials reflect evenly in all directions and do not shine, as `lightwell render` shows them
// by one part of the light: `?light=` names it as the element does. With `&glossy` they stay what they are.
import { Mesh, MeshLambertMaterial, MeshStandardMaterial } from 'three';
import '../../../web/src/element/index.js';
import type { LightwellView } from '../../../web/src/element/lightwell_view.js';

function lambert({ color, map, side, vertexColors }: MeshStandardMaterial): MeshLambertMaterial {
  return new MeshLambertMaterial({ color, map, side, vertexColors });
}

const query = new URLSearchParams(location.search);
const light = query.get('light');
document.body.innerHTML = `<lightwell-view src="pack.lw.glb" tone="none" light="${light}" style="position: fixed; inset: 0">`;
const view = document.querySelector<LightwellView>('lightwell-view')!;
view.on('load', () =>
  view.pack!.traverse((object) => {
    if (query.has('glossy')) return;
    if (object instanceof Mesh && object.material instanceof MeshStandardMaterial) object.material = lambert(object.material);
  }),
);

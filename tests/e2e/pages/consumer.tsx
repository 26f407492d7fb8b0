// SPDX-License-Identifier: Apache-2.0
//
// What people write in TypeScript and React. It is compiled, not run: a line after @ts-expect-error has to be refused.
import { LightwellView, type View } from 'lightwell/element';
import type {} from 'lightwell/react';
import { LightwellLoader, type LightwellScene } from 'lightwell/three';
import { PackConnection } from 'lightwell';
import { Scene, WebGLRenderer } from 'three';

const view = document.createElement('lightwell-view');
const same: LightwellView = view;
const element: HTMLElement = same;
element.append(document.querySelector('lightwell-view') ?? '');
view.addEventListener('progress', (event) => console.log(event.detail.bytes.done / event.detail.bytes.total));
view.addEventListener('error', ({ detail }) => console.error(detail.reason, detail.message));
view.addEventListener('camera-change', ({ detail }) => keep(detail));
view.addEventListener('click', (event) => console.log(event.clientX));
view.addEventListener('a-page-of-its-own', (event) => console.log(event.type));
// @ts-expect-error: no such detail
view.addEventListener('error', ({ detail }) => console.error(detail.cause));

function keep(view: View): number {
  return view.theta + view.target[0];
}

export const room = (
  <lightwell-view src="room.lw.glb" camera-controls="always" light="indirect" loading="lazy" ref={(found) => void found?.pause()}>
    <p slot="error">Not here.</p>
  </lightwell-view>
);
// @ts-expect-error: no such light
export const wrong = <lightwell-view light="dim" />;

export async function load(renderer: WebGLRenderer): Promise<LightwellScene> {
  const pack = await new LightwellLoader().setRenderer(renderer).loadAsync('room.lw.glb');
  new Scene().add(pack);
  pack.addEventListener('progress', ({ progress }) => console.log(progress.rate));
  new PackConnection('room.lw.glb').close();
  return pack;
}

// SPDX-License-Identifier: Apache-2.0
import type { Progress, Share } from '../core/protocol.js';
import type { LightwellView } from '../element/lightwell_view.js';

const FRAME_RATE_INTERVAL = 500;

/** Fills the bars and figures of the panel. */
export function bindProgress(view: LightwellView): void {
  view.on('progress', show);
  view.on('complete', () => set('rate', 'complete'));
  setInterval(() => {
    const rate = Math.round(view.frameRate);
    set('frame-rate', rate > 0 ? `${rate} fps` : view.complete ? 'still' : '');
  }, FRAME_RATE_INTERVAL);
}

function show({ geometry, light, faces, nodes, bytes, rate }: Progress): void {
  fill('geometry', geometry);
  fill('light', light);
  set('faces', faces.total > 0 ? `${count(faces.done)} faces` : '');
  set('nodes', nodes.total > 0 ? `${count(nodes.done)} nodes` : '');
  set('bytes', `${megabytes(bytes.done)} of ${megabytes(bytes.total)}`);
  set('rate', rate > 0 ? `${megabytes(rate)}/s` : '');
}

function fill(id: string, { done, total }: Share): void {
  const bar = document.getElementById(id)!;
  const share = total > 0 ? done / total : 0;
  bar.setAttribute('aria-valuenow', String(Math.round(100 * share)));
  (bar.firstElementChild as HTMLElement).style.transform = `scaleX(${share})`;
}

function set(id: string, text: string): void {
  document.getElementById(id)!.textContent = text;
}

/** 1234567 as "1.23 M". */
function count(value: number): string {
  if (value >= 1e6) return `${(value / 1e6).toPrecision(3)} M`;
  return value >= 1e4 ? `${Math.round(value / 1e3)} k` : String(value);
}

function megabytes(bytes: number): string {
  return bytes >= 1e6 ? `${(bytes / 1e6).toPrecision(3)} MB` : `${Math.round(bytes / 1e3)} kB`;
}

// SPDX-License-Identifier: Apache-2.0
import type { LightwellView } from '../element/lightwell_view.js';

const AWAY = 'The server does not answer. What has come is kept; the rest follows when it is back.';

/** Says when the server is away and when something went wrong. */
export function bindNotice(view: LightwellView): { fail(message: string): void } {
  const notice = document.querySelector<HTMLElement>('#notice')!;
  const show = (text: string, error: boolean) => {
    notice.textContent = text;
    notice.classList.toggle('error', error);
    notice.hidden = text === '';
  };
  view.on('connection', ({ state }) => show(state === 'waiting' ? AWAY : '', false));
  view.on('error', ({ reason, message }) => {
    if (reason === 'replaced') show('The file has changed. Loading the new one.', false);
    else if (reason === 'unsupported') show(message, true);
    else show(`${view.loaded ? 'The rest of this scene' : 'This scene'} cannot be shown. ${message}`, true);
  });
  view.on('load', () => show('', false));
  return { fail: (message) => show(message, true) };
}

// SPDX-License-Identifier: Apache-2.0
//
// <lightwell-view> in React's JSX: `import type {} from 'lightwell/react';` anywhere in a project.
import type { DetailedHTMLProps, HTMLAttributes } from 'react';
import type { LightwellView, LightwellViewAttributes } from './element/index.js';

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'lightwell-view': DetailedHTMLProps<HTMLAttributes<LightwellView>, LightwellView> & LightwellViewAttributes;
    }
  }
}

// SPDX-License-Identifier: Apache-2.0
//
// The npm packages of web/, for files that do not lie below it.
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

export const ROOT = fileURLToPath(new URL('../..', import.meta.url));
export const WEB = `${ROOT}web/`;
const require = createRequire(`${WEB}package.json`);

export const { chromium } = require('playwright-core');
export const { build } = require('esbuild');
export const { validateBytes } = require('gltf-validator');
export const { NodeIO } = require('@gltf-transform/core');
export const three = await import(require.resolve('three').replace('three.cjs', 'three.module.js'));

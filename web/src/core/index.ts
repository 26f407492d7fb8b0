// SPDX-License-Identifier: Apache-2.0
//
// Streaming and decoding of packs without a renderer.
export { PackConnection, type ConnectionOptions } from './connection.js';
export * from './protocol.js';

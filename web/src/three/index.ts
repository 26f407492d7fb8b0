// SPDX-License-Identifier: Apache-2.0
//
// Packs in three.js.
export type { Shadows } from './direct/direct_light.js';
export type { Lamp } from './direct/lamp.js';
export { Frame, FrameScheduler, FrameTask } from './frame_scheduler.js';
export { LightwellLight, type LightLookup } from './light.js';
export { PackError } from './pack_error.js';
export { LightwellLoader, type LoaderOptions } from './loader.js';
export { LightwellScene, type LightwellSceneEventMap, type SceneOptions } from './scene.js';
export { BYTES_PER_FRAME } from './upload_budget.js';

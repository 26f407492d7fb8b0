// SPDX-License-Identifier: Apache-2.0

/** Bytes that may be handed to the GPU between two frames, so that frames do not stall. */
export const BYTES_PER_FRAME = 256 * 1024;

/** What is left of a frame's bytes. */
export class UploadBudget {
  left = BYTES_PER_FRAME;

  /** Takes `bytes` when they are left. A piece that no frame has room for is let through as a frame's only one. */
  take(bytes: number): boolean {
    if (bytes > this.left && this.left < BYTES_PER_FRAME) return false;
    this.left = Math.max(0, this.left - bytes);
    return true;
  }
}

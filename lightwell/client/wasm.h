// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// The client as a WebAssembly module: lightwell.wasm. It imports nothing; `_initialize()` must be called once after
/// instantiation.
///
/// All values are numbers. A `client` is a handle from lw_create. Bytes go in through the buffer that lw_input returns,
/// and come out as a pointer and a length into the module's memory. These bytes and the record are valid until the next
/// call of any function: copy them, and make a new view of memory.buffer after every call, since memory may have grown.
/// Times are seconds from any start, as a double. Reserved or unused words of the record are 0.
extern "C" {

/// The version of this interface: 2.
uint32_t lw_abi_version();

/// Creates a client. strategy: 0 interleave, 1 geometry, 2 light. fill: 0 push-pull, 1 push-pull-smooth, 2 none.
uint32_t lw_create(uint32_t strategy, uint32_t fill, uint32_t seed);
void lw_destroy(uint32_t client);

/// A buffer of at least `length` bytes for the input of the next call.
uint8_t* lw_input(uint32_t length);
/// The record: 32 little-endian words of 32 bits in which the functions below leave their results.
const uint32_t* lw_record();

// clang-format off
/// The next action of the client, 0 for none; call until it returns 0.
///   1 ask:     [0] request, [1] first byte, [2] last byte (inclusive): fetch with only the header "Range: bytes=first-last"
///              or without it when [2] is 2^32 - 1
///   2 cancel:  [0] request: abort it and report nothing more about it
// clang-format on
uint32_t lw_next(uint32_t client, double now);
/// A response begins. The input holds the text of the Content-Range header, then that of the ETag; a length is 0 when
/// the header is absent or hidden.
void lw_respond(uint32_t client, uint32_t request, uint32_t status, uint32_t content_range_length, uint32_t etag_length,
                double now);
/// The next `length` bytes of a body, in the input.
void lw_receive(uint32_t client, uint32_t request, uint32_t length, double now);
/// The body ended.
void lw_finish(uint32_t client, uint32_t request, double now);
/// No response, or the connection broke.
void lw_fail(uint32_t client, uint32_t request, double now);
/// When to call lw_next again although nothing happened; may lie in the past, infinity when there is no need.
double lw_wake(uint32_t client);

/// Decodes at most one block and fills at most one light grid; 0 when there was nothing to do. A mesh accepts no
/// further block while its updates are only partly taken: call again after lw_take.
uint32_t lw_work(uint32_t client);
// clang-format off
/// The next update, of at most about `budget` bytes, 0 for none; updates must be applied in order. `asset` is the
/// number defined in asset/asset.h, currently that of the stream in the JSON extensions of the opening.
///   1 opening:   [0] pointer, [1] length: a GLB for GLTFLoader
///   2 mesh:      [0] asset, [1] vertices, [2] faces, [3] number of attributes, then a word for each:
///                semantic (0 position, 1 normal, 2 texcoord_0, 3 texcoord_1, 4 color)
///                | component << 8 (0 i8, 1 u8, 2 i16, 3 u16, 4 f32)
///                | numbers a vertex << 16 | stride in bytes << 20 | normalized << 31
///   3 range:     [0] asset, [1] buffer (an attribute of the mesh, or 255: indices), [2] offset in bytes,
///                [3] pointer, [4] length
///   4 draw:      [0] asset, [1] vertices, [2] faces: draw so many from now on, [3] pointer, [4] number of regions: of
///                each how many of its faces, as 32-bit words; its indices lie behind those of the regions before it
///   5 light:     [0] asset, [1] width, [2] height, [3] depth, [4] nodes received, [5] pointer, [6] length: RGBA16F texels
///   6 texture:   [0] asset, [1] format (0 PNG, 1 JPEG, 2 WebP), [2] width, [3] height, [4] pointer, [5] length:
///                an image file
///   7 complete
///   8 failure:   [0] reason (0 unreadable, 1 replaced, 2 refused), [1] pointer, [2] length: a message, UTF-8
///   9 parts:     [0] asset, [1] bytes of the JSON, [2] pointer, [3] length: a gzip file of it
// clang-format on
uint32_t lw_take(uint32_t client, uint32_t budget);

/// Sets how much an asset matters to the current picture, initially 1. A run of blocks is valued by the share of its
/// stream's first error that it removes, times this weight. Ignored before the opening update.
void lw_set_weight(uint32_t client, uint32_t asset, float weight);
/// Changes the strategy, numbered as for lw_create, from the next request on.
void lw_set_strategy(uint32_t client, uint32_t strategy);

/// The blocked links of a light grid, for a view of it: [0] pointer, [1] number of floats: x, y, z of both ends of
/// each.
void lw_blocked_links(uint32_t client, uint32_t asset);

// clang-format off
/// Writes the progress to the record. Byte counts are below 4 GiB:
///   [0] bytes, [1] of, [2] geometry bytes, [3] of, [4] light bytes, [5] of, [6] faces, [7] of, [8] nodes, [9] of,
///   [10] requests, [11] consecutive failures (not 0 while the server is away)
// clang-format on
void lw_progress(uint32_t client);
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "lightwell/client/run_order.h"

namespace lightwell {

/// Which streams go first. The numbers are those of client/wasm.h.
enum class Strategy : uint8_t {
  interleave,  ///< whatever removes the most error per byte
  geometry,    ///< all meshes, then textures, then light
  light        ///< all light, then meshes and textures
};

/// The run to request next: about `length` bytes of one stream; nullopt when nothing known is missing. Of the streams
/// that the strategy puts first, it is the one whose run removes the largest share of its stream's first error (of
/// bricks: of their grid's) per byte, times the stream's weight (`weights` has one per stream); ties go to light.
/// `in_flight` is the number of such runs that fill the connection: a table page is requested before its stream runs
/// dry.
std::optional<Run> choose(RunOrder& order, Strategy strategy, std::span<const float> weights, uint64_t length,
                          uint64_t in_flight);

}  // namespace lightwell

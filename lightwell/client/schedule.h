// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "lightwell/client/run_order.h"

namespace lightwell {

/// Which streams go first. The numbers are those of client/wasm.h.
enum class Strategy : uint8_t {
  interleave,  ///< whatever takes most of the error away per byte
  geometry,    ///< all meshes, then textures, then light
  light        ///< all light, then meshes and textures
};

/// The run to ask for next, of the missing ones: a run of about `length` bytes of one stream. Among the streams that
/// the strategy lets go first it is the one whose run takes away the largest share of the stream's first error per
/// byte, times the stream's weight, of which there is one a stream; light goes first in equal cases. `in_flight` is how
/// many such runs fill the line: a table page is asked for before a stream runs dry.
std::optional<Run> choose(RunOrder& order, Strategy strategy, std::span<const float> weights, uint64_t length,
                          uint64_t in_flight);

}  // namespace lightwell

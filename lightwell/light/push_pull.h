// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "lightwell/light/grid.h"

namespace lightwell {

/// How to fill nodes that have not arrived. The numbers are those of client/wasm.h.
enum class Fill : uint8_t {
  push_pull = 0,         ///< interpolation from a pyramid of the known nodes
  push_pull_smooth = 1,  ///< the same, with the filled values of each level smoothed (see push_pull)
  none = 2               ///< no light
};

/// Fills the nodes of `grid` whose entry in `known` (one byte per node) is 0. Known nodes never change, a constant
/// field stays exactly constant, and the result is the same on every machine. Takes linear time for any shape.
///
/// 3D push-pull as in S08 (Pacanowski, Granier et al., "Efficient Streaming of 3D Scenes with Complex Geometry and
/// Complex Lighting", Web3D 2008; section 4.1, Figures 2 and 7): pull averages the known values of 2x2x2 nodes
/// into a coarser level, up to a single value; push fills unknown nodes by trilinear interpolation of the coarser
/// level. Invalid nodes count with node_weight, so that their fill spreads only where nothing better is known. An
/// unknown node becomes valid when the validity interpolated in the same way is at least one half. With no node known,
/// all become dark and valid.
void push_pull(LightGrid& grid, std::span<const uint8_t> known, Fill fill);

}  // namespace lightwell

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "lightwell/light/grid.h"

namespace lightwell {

/// The stand-in for nodes that have not arrived. The numbers are those of client/wasm.h.
enum class Fill : uint8_t {
  push_pull = 0,         ///< interpolation from a pyramid of the known nodes
  push_pull_smooth = 1,  ///< the same, each level's filled values smoothed (S08, Figure 7; see push_pull)
  none = 2               ///< no light
};

/// Fills the nodes of `grid` whose entry in `known` (a byte a node) is 0. Known nodes never change, a constant field
/// stays constant exactly, and the result is the same on every machine. Time is linear in the number of nodes, for any
/// shape.
///
/// 3D push-pull as in S08 (Pacanowski et al., Efficient Streaming of 3D Scenes with Complex Geometry and Complex
/// Lighting, Web3D 2008, Figure 2): pull means the known values of 2x2x2 nodes into a coarser level, up to a single
/// value; push gives unknown nodes the trilinear interpolation of the coarser level. Invalid nodes count with
/// node_weight, so that their fill spreads only where nothing better is known; an unknown node counts as valid when the
/// same interpolation of its surroundings' validity is at least one half. With nothing known at all every node is dark
/// and valid.
void push_pull(LightGrid& grid, std::span<const uint8_t> known, Fill fill);

}  // namespace lightwell

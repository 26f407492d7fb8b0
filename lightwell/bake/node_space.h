// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/free_space.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// How much of the space round each node of a grid is free.
struct NodeSpace {
  std::vector<float> free_share;  ///< the share of the node's box that is free space
  std::vector<uint8_t> valid;     ///< 1 where the node stands in free space, 0 in a solid or a thin wall
};

/// Measures the free space by one ray in a random direction from each of a number of stratified points of a node's box;
/// boxes that surfaces cut get more points. A point is free unless its ray ends on a surface from the inside of a
/// solid, or, in a closed scene, hits nothing, since then it lies outside. The result is the same for any number of
/// threads.
NodeSpace measure_node_space(const TraceScene& scene, const FreeSpace& space, const GridShape& shape, uint64_t seed,
                             int threads);

}  // namespace lightwell

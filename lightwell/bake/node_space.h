// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/free_space.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// How much of the space round each node of a grid is free.
struct NodeSpace {
  std::vector<float> free_share;  ///< of the node's box: the part of it that is free space
  std::vector<uint8_t> valid;     ///< 1 where the node stands in free space, 0 in a solid or a thin wall
};

/// Measures it by rays. The free share of a box: of points of the box, one ray each in a random direction, those that
/// do not end inside a solid. In a closed scene a ray that meets nothing has left it, and counts as one that did.
/// Points are stratified, more of them in boxes that surfaces cut. The same for any number of threads.
NodeSpace measure_node_space(const TraceScene& scene, const FreeSpace& space, const GridShape& shape, uint64_t seed,
                             int threads);

}  // namespace lightwell

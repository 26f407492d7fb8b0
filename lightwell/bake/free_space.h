// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/solids.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// The share of each node's box from which one sees the free space of the scene: of points of the box, one ray each in
/// a random direction, those that do not end inside a solid. In a closed scene a ray that meets nothing has left it,
/// and counts as one that did. Points are stratified, more of them in boxes that surfaces cut.
std::vector<float> free_shares(const TraceScene& scene, const Solids& solids, const GridShape& shape, bool closed,
                               uint64_t seed, int threads);

}  // namespace lightwell

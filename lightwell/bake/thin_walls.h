// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/free_space.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// The grid over the scene's region with `longest` nodes on its longest axis (GridShape::over), and on each axis up to
/// an eighth more where that puts nodes into walls that would otherwise stand between nodes. A wall thinner than a cell
/// leaks where floors and ceilings meet it: between its two sides a lookup interpolates from one room's nodes to the
/// other's, and only a node inside the wall, which is invalid, keeps the two apart (docs/decisions/010-thin-walls.md).
GridShape grid_of_walls(const World& world, int longest);

/// True for a node inside a wall thinner than a cell: both ways along some axis one meets the back of a solid within
/// half a cell. Its box would mix the light of both sides.
bool is_in_thin_wall(const TraceScene& scene, const FreeSpace& space, const GridShape& shape, size_t node);

}  // namespace lightwell
